//! Random nets with everything that the notation has, for the comparison of engines and forms, and with the definition.

mod boxes;
mod calm;
mod conditions;
mod gates;
mod parts;
mod program;
mod smaller;

pub use program::{Stimulus, configuration, shared_stimulus};
pub use smaller::{smaller, written_out};

use crate::definition::expression::{Expression, Value};
use crate::definition::model::{Active, Class, Input, Kind, Net, Statement, Stop, Target, Word};
use crate::dice::Dice;

/// The dice of a batch of nets.
pub fn dice(seed: u64) -> Dice {
    Dice(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ 0x1234_5678_9abc_def1)
}

/// What a random net may have.
#[derive(Clone, Copy)]
pub struct Wanted {
    /// Tokens with attributes.
    pub classes: bool,
    /// An operator.
    pub modes: bool,
    /// No time, no GENERATE box and no operator: where no input changes, the net comes to rest.
    pub calm: bool,
}

/// One net in the making.
struct Maker<'d> {
    dice: &'d mut Dice,
    net: Net,
    /// Ints and reals that can be read, before there are boxes.
    ints: Vec<String>,
    reals: Vec<String>,
    /// Outputs and locals that statements may write.
    writable: Vec<Word>,
    /// Outputs and locals that boxes may drive.
    drivable: Vec<String>,
    repetitions: usize,
}

fn int(name: &str, first: i32) -> Word {
    Word { name: name.to_owned(), first: Value::Int(first) }
}

fn real(name: &str, first: f64) -> Word {
    Word { name: name.to_owned(), first: Value::Real(first) }
}

fn input(first: Word) -> Input {
    Input { name: first.name, first: first.first, size: None, cell: false }
}

/// A random net, with random nets inside.
pub fn net(dice: &mut Dice, name: &str, wanted: Wanted) -> Net {
    if wanted.calm {
        return calm::net(dice, name, wanted);
    }
    // Some nets need more than one word for the sets of boxes and gates.
    let many = if dice.once_in(10) { 60 } else { 0 };
    let mut maker = Maker::new(dice, name);
    maker.head(wanted.modes);
    if wanted.classes && maker.dice.once_in(2) {
        maker.classes();
    }
    let boxes = 3 + maker.dice.below(8 + many);
    (0..boxes).for_each(|at| maker.place(&format!("p{at}")));
    if maker.dice.once_in(2) {
        maker.row();
    }
    if maker.dice.once_in(2) {
        maker.queue();
    }
    maker.first_operation();
    if maker.dice.once_in(2) {
        maker.inside(name, wanted.modes);
    }
    let gates = 3 + maker.dice.below(10 + many);
    (0..gates).for_each(|at| maker.gate(&format!("g{at}")));
    maker.outputs_without_a_writer();
    maker.active("step", "at");
    maker.active("step2", "at2");
    maker.net
}

impl<'d> Maker<'d> {
    fn new(dice: &'d mut Dice, name: &str) -> Maker<'d> {
        Maker {
            dice,
            net: Net { name: name.to_owned(), ..Net::default() },
            ints: Vec::new(),
            reals: Vec::new(),
            writable: Vec::new(),
            drivable: Vec::new(),
            repetitions: 0,
        }
    }

    fn head(&mut self, modes: bool) {
        let started = self.dice.once_in(3);
        let first = |value: i32| if started { value } else { 0 };
        let half = if started { 0.25 } else { 0. };
        self.net.outputs = vec![
            int("y0", first(1)),
            int("y1", 0),
            int("w0", first(2)),
            int("w1", 0),
            real("r0", half),
            int("w2", first(3)),
        ];
        self.net.outputs.extend([int("step", 0), real("at", 0.), int("step2", 0), real("at2", 0.)]);
        self.net.locals =
            vec![int("kept", first(1)), real("l1", half), int("y2", 0), int("s1", 0), real("t1", 0.), int("n1", 0)];
        self.net.inputs = ["x0", "x1", "x2"].map(|name| input(int(name, 0))).to_vec();
        self.net.inputs.push(input(real("v", 0.)));
        self.net.inputs.push(Input { size: Some(3), ..input(int("z", 0)) });
        self.net.inputs.push(Input { size: Some(2), ..input(real("u", 0.)) });
        self.net.inputs.push(Input { cell: true, ..input(int("cmd", 0)) });
        self.net.parameters = vec![real("par", 0.7), int("lim", 2)];
        self.net.momentary.push("cmd".to_owned());
        let ints = [
            "x0", "x1", "x2", "z[1]", "z[2]", "z[3]", "cmd", "y0", "w0", "w1", "step", "step2", "kept", "y2", "s1",
            "w2", "n1", "lim",
        ];
        self.ints = ints.map(str::to_owned).to_vec();
        self.reals = ["v", "u[1]", "u[2]", "r0", "at", "at2", "l1", "t1", "par"].map(str::to_owned).to_vec();
        self.writable = vec![int("w0", 0), int("w1", 0), real("r0", 0.), int("kept", 0), real("l1", 0.)];
        self.drivable = ["y0", "y1", "y2"].map(str::to_owned).to_vec();
        if modes && self.dice.once_in(2) {
            self.operator();
        }
        if self.dice.once_in(2) {
            self.net.outputs.push(int("why", 0));
            self.net.blocked = Some("why".to_owned());
            self.ints.push("why".to_owned());
        }
    }

    /// MODE, with all its commands or the first ones, and what outputs are meanwhile.
    fn operator(&mut self) {
        let commands = ["mode", "go", "fire", "put", "take"];
        let known = if self.dice.once_in(3) { 1 + self.dice.below(4) } else { 5 };
        for name in &commands[..known] {
            self.net.inputs.push(Input { cell: true, ..input(int(name, 0)) });
            self.net.mode.push((*name).to_owned());
        }
        self.ints.push("mode".to_owned());
        let outputs = self.net.outputs.clone();
        let known = |name: &&str| outputs.iter().any(|word| word.name == *name);
        for output in ["y0", "w0", "r0"].into_iter().filter(|name| known(name)) {
            let stop = match (self.dice.roll(3), output) {
                (0, _) => continue,
                (1, _) => Stop::Hold,
                (_, "r0") => Stop::Is(Value::Real(0.5)),
                (_, "y0") => Stop::Is(Value::Int(1)),
                (_, _) => Stop::Is(Value::Int(7)),
            };
            self.net.stops.push((output.to_owned(), stop));
        }
    }

    fn classes(&mut self) {
        let attributes = |names: [Word; 2]| names.to_vec();
        let class = |name: &str, attributes| Class { name: name.to_owned(), attributes };
        self.net.classes.push(class("c", attributes([int("a", 1), real("b", 0.5)])));
        if self.dice.once_in(2) {
            self.net.classes.push(class("d", attributes([real("e", 2.), int("a", 3)])));
        }
    }

    /// An ACTIVE line over boxes of this net.
    fn active(&mut self, step: &str, time: &str) {
        let mut of: Vec<String> = Vec::new();
        for _ in 0..1 + self.dice.below(4) {
            let name = self.net.boxes[self.dice.below(self.net.boxes.len())].name.clone();
            if !of.contains(&name) {
                of.push(name);
            }
        }
        self.net.active.push(Active { step: step.to_owned(), time: Some(time.to_owned()), of });
    }

    /// Every output must be driven or written.
    fn outputs_without_a_writer(&mut self) {
        if self.net.parts.iter().all(|part| part.bound("w2").next().is_none()) {
            let value = Expression::Number(Value::Int(2));
            let act = Statement { target: Target::Word("w2".to_owned()), value };
            let first = self.net.boxes.iter_mut().find(|place| place.name == "begin");
            if let Some(Kind::Operation(acts)) = first.map(|place| &mut place.kind) {
                acts.push(act);
            }
        }
        for output in ["y0", "y1"] {
            if !self.net.is_driven(output) {
                self.net.boxes[0].drives.push(output.to_owned());
            }
        }
    }

    /// An operation that is marked at the start, and writes each output that can be written.
    fn first_operation(&mut self) {
        let mut place = boxes::plain("begin", Kind::State);
        place.marked = 1;
        let writes = self.net.outputs.iter().filter(|word| self.writable.iter().any(|known| known.name == word.name));
        let acts = writes.map(|word| boxes::first_write(&word.name, word.first)).collect();
        place.kind = Kind::Operation(acts);
        self.net.boxes.push(place);
    }
}
