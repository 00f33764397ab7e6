//! Random nets with everything that the notation has, for the comparison of engines and forms.

use crate::dice::Dice;
use std::fmt::Write;

/// The dice of a batch of nets.
pub fn dice(seed: u64) -> Dice {
    Dice(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ 0x1234_5678_9abc_def1)
}

/// Nets that stand inside others: a macro, one with a macro inside, a module. File name and text.
pub const INNER: [(&str, &str); 4] = [
    (
        "mac.net",
        "int out, int n = mac ( int x : real length = 0.6 )\nENTRY come\nTIME flow length DRIVES out\nEXIT gone\n\
         GATE a : come -> flow IF x\nDO n = n + 1\nGATE b : flow -> gone\nGATE c : flow -> come IF x AND n > 9\nDO n = 0\nEND\n",
    ),
    (
        "nest.net",
        "int out, int n = nest ( int x : )\nLOCAL int m\nENTRY come\nEXIT gone\nMACRO I : out, m = mac ( x : length = 0.3 )\n\
         SIGNAL told DO n = m\nGATE a : come -> I\nGATE b : I -> told\nGATE c : told -> gone IF NOT x\nEND\n",
    ),
    (
        "carry.net",
        "int out, int n = carry ( int x, int more : )\nCLASS c ( int a = 1, real b = 0.5 )\nENTRY come OF c\n\
         PROCESS work OF c DRIVES out UNTIL x\nDO work.a = work.a + more\nEXIT gone OF c\nGATE a : come -> work\n\
         DO n = n + come.a\nGATE b : work -> gone\nDO work.b = work.b - 0.25\nEND\n",
    ),
    (
        "device.net",
        "int out, int step, real t = device ( int x, real v : )\nACTIVE step, t OF shut, open, moving\nSTATE shut MARKED\n\
         STATE open DRIVES out\nTIME moving v DRIVES out\nGATE a : shut -> moving IF x\nGATE b : moving -> open\n\
         GATE c : open -> shut IF NOT x AND t > 0.4\nEND\n",
    ),
];

/// One net in the making.
struct Maker<'d> {
    dice: &'d mut Dice,
    kinds: Vec<&'static str>,
    classed: Vec<bool>,
    /// Places of plain tokens in a buffer; else 1.
    sizes: Vec<u64>,
    parts: bool,
    text: String,
}

const CONDITIONS: [&str; 16] = [
    "x0",
    "x1",
    "NOT x0",
    "NOT x2",
    "x0 AND x1",
    "x1 OR NOT x2",
    "v > 0.5",
    "1./v > 2.",
    "p0 > 0",
    "p1 == 0",
    "y0",
    "w0 > 3",
    "step == 2",
    "at > 0.6",
    "cmd",
    "NOT (v < 0.2) AND p2 == 0",
];

const STATEMENTS: [&str; 8] =
    ["w0 = w0 + 1", "w0 = 3", "w0 = x2", "r0 = v * 2.", "r0 = r0 + 0.5", "kept = kept + 1", "w0 = kept", "kept = 0"];

const PERMISSIVES: [&str; 6] = ["x1", "v > 0.3", "NOT x2", "kept < 9", "1./v > 0.5", "x0, (2.*v > 0.5 OR NOT x1)"];

const TIMES: [&str; 5] = ["0.3", "1.", "par", "v", "x2"];

/// The text of a random net called `name`, perhaps with classes of tokens.
pub fn net(dice: &mut Dice, name: &str, classes: bool) -> String {
    // Some nets need more than one word for the sets of boxes and gates.
    let many = if dice.once_in(10) { 60 } else { 0 };
    let boxes = (3 + dice.roll(8 + many)) as usize;
    let classes = classes && dice.once_in(2);
    let parts = dice.once_in(2);
    let mut maker =
        Maker { dice, kinds: Vec::new(), classed: Vec::new(), sizes: Vec::new(), parts, text: String::new() };
    let _ = writeln!(
        maker.text,
        "int y0, int y1, int w0, real r0, int step, real at = {name} ( int x0, int x1, int x2, real v, cell int cmd = 0 : \
         real par = 0.7 )\nMOMENTARY cmd\nLOCAL int kept = 0, int y2, int w1, int s1, real t1\nACTIVE step, at OF p0, p1, p2"
    );
    if maker.dice.once_in(3) {
        maker.text.push_str("START w0 = 2, r0 = 0.25, y0 = 1\n");
    }
    if classes {
        maker.text.push_str("CLASS c ( int a = 1, real b = 0.5 )\n");
    }
    (0..boxes).for_each(|i| maker.place(i, classes));
    maker.text.push_str("OPERATION begin MARKED\nDO r0 = 0.1\nDO w0 = w0 + 1\n");
    if parts {
        maker.inner();
    }
    let gates = 3 + maker.dice.roll(10 + many);
    (0..gates).for_each(|i| maker.gate(i));
    maker.text.push_str("END\n");
    maker.text
}

impl Maker<'_> {
    fn condition(&mut self) -> &'static str {
        self.dice.one(&CONDITIONS)
    }

    fn place(&mut self, index: usize, classes: bool) {
        let kind = self.dice.one(&[
            "STATE",
            "STATE",
            "STATE",
            "CAPACITY",
            "CAPACITY",
            "TIME",
            "COUNT",
            "OPERATION",
            "SIGNAL",
            "PROCESS",
            "GENERATE",
        ]);
        let classed = classes && kind != "COUNT" && self.dice.once_in(2);
        let _ = write!(self.text, "{kind} p{index}");
        let size = 1 + self.dice.roll(4);
        match kind {
            "TIME" if classed && self.dice.once_in(2) => {
                let _ = write!(self.text, " p{index}.b");
            }
            "TIME" => {
                let time = self.dice.one(&TIMES);
                let _ = write!(self.text, " {time}");
            }
            "COUNT" => {
                let _ = write!(self.text, " {size}");
            }
            "CAPACITY" if classed || !self.dice.once_in(4) => {
                let _ = write!(self.text, " SIZE {size}");
                if classed && self.dice.once_in(2) {
                    let order = self.dice.one(&["lifo", "least a", "most b"]);
                    let _ = write!(self.text, " ORDER {order}");
                }
            }
            "GENERATE" => {
                let condition = self.condition();
                let _ = write!(self.text, " SIZE {size} WHEN {condition}");
            }
            _ => {}
        }
        if classed {
            self.text.push_str(" OF c");
        }
        if kind != "GENERATE" && self.dice.once_in(2) {
            self.text.push_str(if classed { " MARKED ( a = 2 )" } else { " MARKED" });
        }
        match index {
            0 => self.text.push_str(" DRIVES y0"),
            1 => self.text.push_str(" DRIVES y1"),
            _ if self.dice.once_in(3) => self.text.push_str(" DRIVES y0"),
            _ => {}
        }
        self.clauses(index, kind, classed);
        self.kinds.push(kind);
        self.classed.push(classed);
        self.sizes.push(if kind == "CAPACITY" && !classed { size } else { 1 });
    }

    fn clauses(&mut self, index: usize, kind: &str, classed: bool) {
        if kind == "PROCESS" {
            if self.dice.once_in(2) {
                let condition = self.condition();
                let _ = write!(self.text, " UNTIL {condition}");
            }
            if self.dice.once_in(2) {
                let time = self.dice.one(&TIMES);
                let _ = write!(self.text, " WITHIN {time}");
            }
        }
        self.text.push('\n');
        let acts =
            matches!(kind, "OPERATION" | "SIGNAL") || (matches!(kind, "PROCESS" | "GENERATE") && self.dice.once_in(2));
        if acts {
            let statement = self.dice.one(&STATEMENTS);
            let _ = writeln!(self.text, "DO {statement}");
            if classed {
                let _ = writeln!(self.text, "DO p{index}.a = p{index}.a + x2");
            }
        }
        if kind == "PROCESS" && self.dice.once_in(2) {
            let answer = self.dice.one(&["NOT p.cause", "x1", "p.cause OR x0"]).replace("p.", &format!("p{index}."));
            let _ = writeln!(self.text, "AFTER p{index}.ready = {answer}");
        }
    }

    fn inner(&mut self) {
        let carried = self.classed.iter().position(|classed| *classed);
        match carried.filter(|_| self.dice.once_in(2)) {
            Some(carrier) => {
                let _ = writeln!(self.text, "MACRO M : y1, w1 = carry ( x1, p{carrier}.a : )");
                self.classed.push(true);
            }
            None => {
                let code = self.dice.one(&["mac", "nest"]);
                let _ = writeln!(self.text, "MACRO M : y1, w1 = {code} ( x1 : )");
                self.classed.push(false);
            }
        }
        if self.dice.once_in(2) {
            let class = self.classed.last().copied();
            let free = (0..self.kinds.len()).find(|i| Some(self.classed[*i]) == class);
            let condition = self.condition();
            if let Some(free) = free {
                let _ = writeln!(self.text, "ABORT {condition} -> p{free}\nDO w0 = 7");
            }
        }
        self.text.push_str("MODULE D : y2, s1, t1 = device ( x0, v : )\n");
        self.kinds.push("MACRO");
        self.sizes.push(1);
    }

    /// Some box whose tokens carry attributes, in half of the cases where there is one.
    fn carrier(&mut self) -> Option<String> {
        let carriers: Vec<usize> = (0..self.classed.len()).filter(|place| self.classed[*place]).collect();
        let wanted = !carriers.is_empty() && self.dice.once_in(2);
        wanted.then(|| self.dice.roll(carriers.len() as u64)).map(|chosen| self.name(carriers[chosen as usize]))
    }

    fn name(&self, index: usize) -> String {
        if self.kinds[index] == "MACRO" { "M".to_owned() } else { format!("p{index}") }
    }

    /// Boxes, each once, with weights where tokens are plain.
    fn arcs(&mut self, most: u64) -> Vec<(usize, u64)> {
        let mut arcs: Vec<(usize, u64)> = Vec::new();
        for _ in 0..self.dice.roll(most) {
            let place = self.dice.roll(self.kinds.len() as u64) as usize;
            if arcs.iter().all(|(known, _)| *known != place) {
                let weight = 1 + self.dice.roll(self.sizes[place].min(2));
                arcs.push((place, weight));
            }
        }
        arcs
    }

    fn list(&self, arcs: &[(usize, u64)]) -> String {
        let arc = |(place, weight): &(usize, u64)| {
            let name = self.name(*place);
            if *weight == 1 { name } else { format!("{weight}*{name}") }
        };
        arcs.iter().map(arc).collect::<Vec<_>>().join(", ")
    }

    fn gate(&mut self, index: u64) {
        let (before, after) = (self.arcs(4), self.arcs(4));
        let _ = write!(self.text, "GATE g{index} : {} -> {}", self.list(&before), self.list(&after));
        for word in ["READ", "INHIBIT"] {
            let arcs = self.arcs(2);
            if !arcs.is_empty() {
                let _ = write!(self.text, " {word} {}", self.list(&arcs));
            } else if self.parts && self.dice.once_in(6) {
                let _ = write!(self.text, " {word} D.open");
            }
        }
        if self.dice.once_in(3) {
            let _ = write!(self.text, " PRIORITY {}", self.dice.roll(5) as i64 - 2);
        }
        if self.dice.once_in(4) {
            let _ = write!(self.text, " PERMIT {}", self.dice.one(&PERMISSIVES));
            if let Some(place) = self.carrier() {
                let _ = write!(self.text, ", {place}.a > {}", self.dice.roll(3));
            }
        }
        let same = before.first().is_some_and(|(first, _)| {
            let class = self.classed[*first];
            after.iter().all(|(place, _)| self.classed[*place] == class || !self.classed[*place])
        });
        let simple = same || after.iter().all(|(place, _)| !self.classed[*place]);
        if simple && self.dice.once_in(2) {
            if self.dice.once_in(2) {
                let condition = self.condition();
                let _ = write!(self.text, " IF {condition}");
            }
            self.text.push('\n');
            if self.dice.once_in(3) {
                let statement = self.dice.one(&STATEMENTS);
                let _ = writeln!(self.text, "DO {statement}");
            }
            return;
        }
        self.text.push('\n');
        self.rules(&before, &after);
    }

    fn rules(&mut self, before: &[(usize, u64)], after: &[(usize, u64)]) {
        let rules = 1 + self.dice.roll(3);
        for rule in 0..rules {
            let last = rule + 1 == rules;
            let holder = before.iter().map(|(place, _)| *place).find(|place| self.classed[*place]);
            match holder {
                Some(place) if self.dice.once_in(2) => {
                    let place = self.name(place);
                    let _ = write!(self.text, "IF {place}.a > {} OR x1", self.dice.roll(4));
                    if let Some(other) = self.carrier() {
                        let _ = write!(self.text, " AND {other}.b <= {place}.b");
                    }
                    self.text.push('\n');
                }
                _ if last && rules > 1 && self.dice.once_in(2) => self.text.push_str("ELSE\n"),
                _ => {
                    let condition = self.condition();
                    let _ = writeln!(self.text, "IF {condition}");
                }
            }
            let mut filled: Vec<usize> = Vec::new();
            for (place, _) in before {
                let (class, mut to) = (self.classed[*place], Vec::new());
                for (target, _) in after {
                    if self.classed[*target] == class && !filled.contains(target) && self.dice.once_in(2) {
                        to.push(self.name(*target));
                        filled.push(*target);
                    }
                }
                let to = if to.is_empty() { "nothing".to_owned() } else { to.join(", ") };
                let _ = writeln!(self.text, "THEN {} -> {to}", self.name(*place));
            }
            let rest: Vec<String> =
                after.iter().filter(|(place, _)| !filled.contains(place)).map(|(place, _)| self.name(*place)).collect();
            if !rest.is_empty() && (last || before.is_empty() || self.dice.once_in(2)) {
                let _ = writeln!(self.text, "THEN NEW -> {}", rest.join(", "));
            }
            if self.dice.once_in(3) {
                let statement = self.dice.one(&STATEMENTS);
                let _ = writeln!(self.text, "DO {statement}");
            }
            if let (Some(place), true) = (holder, self.dice.once_in(3)) {
                let place = self.name(place);
                let _ = writeln!(self.text, "DO {place}.b = {place}.b + v");
                if let Some(other) = self.carrier() {
                    let _ = writeln!(self.text, "DO {other}.a = {other}.a + {place}.a - 1");
                }
            }
        }
    }
}

/// A configuration that runs nets side by side, `r0`, `r1`, .., over the same inputs.
pub fn configuration(nets: usize) -> String {
    let mut text =
        "CONTROL\n1 x0 = msi ( : 0 )\n2 x1 = msi ( : 0 )\n3 x2 = msi ( : 0 )\n4 u = msc ( : 0. )\n5 x3 = msi ( : 0 )\n\
         6 v = u + 0.*u/(u - 0.1)\n"
            .to_owned();
    for i in 0..nets {
        let _ = writeln!(text, "{} N{i} = r{i} ( x0, x1, x2, v, x3 : )", i + 10);
    }
    text + "END\n"
}

/// Values of the inputs for so many scans: they change now and then, `v` is bad while `u` is 0.1.
pub fn stimulus(dice: &mut Dice, scans: u64) -> String {
    let mut text = "k,x0.value,x1.value,x2.value,u.value,x3.value\n".to_owned();
    let (mut ints, mut real) = ([0_u64; 4], "0.");
    for scan in 0..scans {
        for int in &mut ints {
            if dice.once_in(4) {
                *int = dice.roll(2);
            }
        }
        if dice.once_in(5) {
            real = dice.one(&["0.", "0.1", "0.4", "0.9", "2.5", "-1."]);
        }
        let [x0, x1, x2, x3] = ints;
        let _ = writeln!(text, "{scan},{x0},{x1},{x2},{real},{x3}");
    }
    text
}
