//! Random nets inside a net: macros, in which a token goes from the entry to the exit, and modules.

use super::Maker;
use super::boxes::plain;
use super::{dice, input, int, real};
use crate::definition::expression::{Expression, Value};
use crate::definition::model::{Abort, Class, Gate, Kind, Net, Part, Route, Rule};

/// The dice of nets that all nets of a program may have inside.
const SHARED: u64 = 12;

impl Maker<'_> {
    /// Macros and modules, some in more than one instance.
    pub(super) fn inside(&mut self, name: &str, modes: bool) {
        if self.dice.once_in(2) {
            let net = match self.dice.once_in(3) {
                true => Maker::new(&mut dice(SHARED), name).device("shared", false),
                false => self.device(&format!("{name}dev"), modes),
            };
            for at in 0..1 + self.dice.below(2) {
                let outputs = vec![Some("y2".to_owned()), Some("s1".to_owned()), Some("t1".to_owned())];
                let outputs = if at == 0 { outputs } else { vec![None, None, None] };
                self.part(&format!("D{at}"), net.clone(), outputs);
            }
        }
        for at in 0..1 + self.dice.below(2) {
            let shared = self.dice.once_in(4);
            let class = if shared { None } else { self.some_class() };
            let net = match shared {
                true => Maker::new(&mut dice(SHARED), name).detail("sharedm", None, false, 2),
                false => self.detail(&format!("{name}m{at}"), class.clone(), modes, 2),
            };
            // Other parts and gates of the net may write the same word.
            let written = self.dice.one(&["w2", "n1", "w0"]);
            let outputs = [("y1", self.dice.once_in(2)), (written, !self.dice.once_in(3))];
            let outputs = outputs.into_iter().map(|(name, is)| is.then(|| name.to_owned())).collect();
            let mut place = plain(&format!("M{at}"), Kind::Macro(self.net.parts.len()));
            place.class = class.map(|class| class.name);
            self.part(&format!("M{at}"), net, outputs);
            self.net.boxes.push(place);
            self.abort();
            self.ways(&format!("M{at}"));
        }
    }

    /// Gates into a macro and out of it.
    fn ways(&mut self, name: &str) {
        let class = self.class_of(name).map(|class| class.name.clone());
        let same = self.net.boxes.iter().filter(|place| place.class == class && place.name != name);
        let same: Vec<String> = same.map(|place| place.name.clone()).collect();
        for (gate, leaves) in [(format!("to{name}"), false), (format!("from{name}"), true)] {
            let other = if same.is_empty() { None } else { Some(same[self.dice.below(same.len())].clone()) };
            let (before, after) = if leaves { (Some(name.to_owned()), other) } else { (other, Some(name.to_owned())) };
            // A token with attributes comes from a box of its class, or is new.
            let route = |from: &Option<String>, to: &Option<String>| Route {
                from: from.clone(),
                to: to.iter().cloned().collect(),
            };
            let routes = if before.is_none() { vec![route(&None, &after)] } else { vec![route(&before, &after)] };
            let condition = self.dice.once_in(2).then(|| self.condition(&[]));
            let arc = |name: Option<String>| name.into_iter().map(|name| (name, 1)).collect();
            let rule = Rule { condition, routes, acts: Vec::new() };
            self.net.gates.push(Gate {
                name: gate,
                before: arc(before),
                after: arc(after),
                rules: vec![rule],
                ..Gate::default()
            });
        }
    }

    fn some_class(&mut self) -> Option<Class> {
        let classes = self.net.classes.len();
        (classes > 0 && self.dice.once_in(2)).then(|| self.net.classes[self.dice.below(classes)].clone())
    }

    fn part(&mut self, name: &str, net: Net, outputs: Vec<Option<String>>) {
        let inputs = net.inputs.iter().map(|input| self.wire(input.first)).collect();
        let parameters =
            if self.dice.once_in(2) { net.parameters.iter().take(1).cloned().collect() } else { Vec::new() };
        let parameters = parameters.into_iter().map(|word| real(&word.name, 0.3)).collect();
        self.net.parts.push(Part { name: name.to_owned(), net, outputs, inputs, parameters, abort: None });
    }

    pub(super) fn wire(&mut self, like: Value) -> Expression {
        if let (Value::Int(_), true) = (like, self.dice.once_in(4)) {
            let name = self.net.boxes[self.dice.below(self.net.boxes.len())].name.clone();
            return Expression::Tokens(name);
        }
        let names = match like {
            Value::Int(_) => &self.ints,
            Value::Real(_) => &self.reals,
        };
        // A parameter is no wire.
        let names: Vec<&String> =
            names.iter().filter(|name| self.net.parameters.iter().all(|word| word.name != **name)).collect();
        Expression::Word(names[self.dice.below(names.len())].clone())
    }

    fn abort(&mut self) {
        let last = self.net.boxes[self.net.boxes.len() - 1].clone();
        let homes = self.net.boxes.iter().filter(|place| {
            place.class == last.class && !matches!(place.kind, Kind::Count(_)) && place.name != last.name
        });
        let homes: Vec<String> = homes.map(|place| place.name.clone()).collect();
        if homes.is_empty() || self.dice.once_in(2) {
            return;
        }
        let (condition, to) = (self.condition(&[]), homes[self.dice.below(homes.len())].clone());
        let acts = self.statements(1, &[]);
        if let Some(part) = self.net.parts.last_mut() {
            part.abort = Some(Abort { condition, to, acts });
        }
    }

    /// The head of a net inside.
    fn small<'d>(dice: &'d mut crate::dice::Dice, name: &str) -> Maker<'d> {
        let mut maker = Maker::new(dice, name);
        maker.net.inputs = vec![input(int("x0", 0)), input(int("x1", 0)), input(real("v", 0.))];
        maker.net.parameters = vec![real("par", 0.6)];
        maker.net.locals = vec![int("kept", 0), real("l1", 0.5)];
        maker.ints = ["x0", "x1", "kept"].map(str::to_owned).to_vec();
        maker.reals = ["v", "l1", "par"].map(str::to_owned).to_vec();
        maker.writable = vec![int("kept", 0), real("l1", 0.)];
        maker
    }

    /// The net of a module: a small random one.
    fn device(&mut self, name: &str, modes: bool) -> Net {
        let mut maker = Maker::small(self.dice, name);
        maker.net.outputs = vec![int("y0", 0), int("step", 0), real("at", 0.)];
        maker.drivable.push("y0".to_owned());
        maker.ints.extend(["y0", "step"].map(str::to_owned));
        if modes && maker.dice.once_in(2) {
            maker.operator();
        }
        (0..2 + maker.dice.below(3)).for_each(|at| maker.place(&format!("p{at}")));
        (0..2 + maker.dice.below(3)).for_each(|at| maker.gate(&format!("g{at}")));
        maker.active("step", "at");
        if !maker.net.is_driven("y0") {
            maker.net.boxes[0].drives.push("y0".to_owned());
        }
        maker.net
    }

    /// The net of a macro: a way from the entry to the exit, and what stands beside it.
    fn detail(&mut self, name: &str, class: Option<Class>, modes: bool, depth: usize) -> Net {
        let mut maker = Maker::small(self.dice, name);
        maker.net.outputs = vec![int("y1", 0), int("w1", 0)];
        maker.drivable.push("y1".to_owned());
        maker.writable.push(int("w1", 0));
        maker.ints.extend(["y1", "w1"].map(str::to_owned));
        maker.net.classes.extend(class.clone());
        if modes && maker.dice.once_in(3) {
            maker.operator();
        }
        let named = class.as_ref().map(|class| class.name.clone());
        let mut entry = plain("come", Kind::Entry);
        entry.class = named.clone();
        maker.net.boxes.push(entry);
        let steps = 1 + maker.dice.below(3);
        for at in 0..steps {
            maker.place(&format!("p{at}"));
            if let Some(place) = maker.net.boxes.last_mut() {
                place.marked = 0;
                place.with.clear();
            }
        }
        if depth > 1 && maker.dice.once_in(3) {
            let inner = maker.detail(&format!("{name}n"), class, false, depth - 1);
            let mut place = plain("I", Kind::Macro(0));
            place.class = named.clone();
            maker.part("I", inner, vec![Some("y1".to_owned()), None]);
            maker.net.boxes.push(place);
            maker.abort();
        }
        if depth > 1 && maker.dice.once_in(3) {
            let beside = maker.device(&format!("{name}b"), false);
            maker.part("B", beside, vec![Some("y1".to_owned()), None, None]);
        }
        let mut exit = plain("gone", Kind::Exit);
        exit.class = named;
        maker.net.boxes.push(exit);
        maker.way();
        (0..maker.dice.below(3)).for_each(|at| maker.gate(&format!("g{at}")));
        maker.net.gates.retain(|gate| !gate.before.is_empty());
        if !maker.net.is_driven("y1") {
            maker.net.boxes[1].drives.push("y1".to_owned());
        }
        let counts = super::boxes::first_write("w1", Value::Int(0));
        if let Some(rule) = maker.net.gates.first_mut().and_then(|gate| gate.rules.first_mut()) {
            rule.acts.push(counts);
        }
        maker.net
    }

    /// Gates from box to box; where the class changes, a new token.
    fn way(&mut self) {
        let names: Vec<String> = self.net.boxes.iter().map(|place| place.name.clone()).collect();
        for (at, pair) in names.windows(2).enumerate() {
            let (from, to) = (pair[0].clone(), pair[1].clone());
            let asked = [from.clone()];
            let condition = self.dice.once_in(3).then(|| self.condition(&asked));
            let same = self.class_of(&from).map(|class| class.name.clone())
                == self.class_of(&to).map(|class| class.name.clone());
            let routes = if same { Vec::new() } else { self.new_tokens(&from, &to) };
            let rule = Rule { condition, routes, acts: self.statements(1, &asked) };
            self.net.gates.push(Gate {
                name: format!("way{at}"),
                before: vec![(from, 1)],
                after: vec![(to, 1)],
                rules: vec![rule],
                ..Gate::default()
            });
        }
    }

    fn new_tokens(&self, from: &str, to: &str) -> Vec<Route> {
        let route = |from: Option<&str>, to: Vec<String>| Route { from: from.map(str::to_owned), to };
        vec![route(Some(from), Vec::new()), route(None, vec![to.to_owned()])]
    }
}
