//! The fast form: code of each gate, tried only while its first box is ready; a scan in which nothing can happen ends at
//! once.
//!
//! A scan does what that of the player does, in the same order. Between its phases stand sets of boxes and gates:
//! `ready` (gates whose first box is excited; `begun`: when the gate phase began), `open` (gates whose input is as they ask), `waiting` (boxes with something
//! to do in the box phase), `touched` (boxes that a gate took from or put into; `moved`: the words of that set), `shown`
//! (boxes that count among those that drive outputs), `outputs` (those whose drivers changed).
//!
//! What a later scan can see and this one changed after its box phase sets `restless`, `waits` or `inside`, in the net and
//! in each one around it: without these and without a change of inputs a scan is passed over. A net inside that was passed
//! over wakes when the net around it moves its tokens; what it told in the last scan is over then.

use super::facts::{generates, waits};
use super::layout::{NetLayout, part_unit};
use super::tokens::{self, Held};
use super::{INDENT, NetBody, classes, commands, ends, firing, gates, inputs, modes, moves, statements, waits};
use crate::bodies::Body;
use crate::expr::Scope;
use crate::layout::WHOLE;
use crate::statics::Statics;
use pcl2_lang::net::{BoxId, Kind, Net, PartId};
use std::fmt::Write;

/// The member of a net inside.
pub(super) fn member(net: &NetBody<'_, '_, '_>, part: usize) -> String {
    statements::instance(net, part).trim_start_matches("self->").to_owned()
}

/// The body of a net inside.
pub(super) fn inner<'c, 'a>(net: &NetBody<'_, 'c, 'a>, part: usize) -> Option<Body<'c, 'a>> {
    Body::new(net.body.cx, part_unit(net.body.unit, net.net, PartId(part as u32))?)
}

/// The start of the names of a net inside.
pub(super) fn part_tag<'c>(net: &NetBody<'_, 'c, '_>, part: usize) -> &'c str {
    inner(net, part).map_or("", |inner| &inner.layout.tag)
}

/// The enumerator of the entry or the exit of a macro.
pub(super) fn end_of(net: &NetBody<'_, '_, '_>, part: PartId, end: impl Fn(&Net) -> Option<BoxId>) -> String {
    let inner = inner(net, part.0 as usize);
    let inside = inner.as_ref().and_then(NetBody::of);
    inside.and_then(|inside| end(inside.net).map(|id| inside.place(id).to_owned())).unwrap_or_default()
}

/// Whether something else than a gate of this net may take the tokens of a box: ABORT, or the net around a macro.
pub(super) fn emptied(net: &NetBody<'_, '_, '_>, id: BoxId) -> bool {
    let aborted = |part: PartId| net.net.parts[part.0 as usize].abort.is_some();
    net.net.exit.is_some() || matches!(net.net.place(id).kind, Kind::Macro(part) if aborted(part))
}

pub(super) fn is_macro(net: &NetBody<'_, '_, '_>, part: usize) -> bool {
    net.net.parts[part].place.is_some()
}

/// The smallest type that holds the tokens with which boxes are ready.
fn full_type(net: &Net) -> &'static str {
    let most = (0..net.boxes.len()).map(|i| full(net, i)).max().unwrap_or(0);
    if most <= u32::from(u16::MAX) { "uint16_t" } else { "int32_t" }
}

/// The tokens with which a box is ready for the gates after it; 0: it waits first.
fn full(net: &Net, id: usize) -> u32 {
    match net.boxes[id].kind {
        Kind::Count => net.boxes[id].capacity.unwrap_or(1),
        Kind::State | Kind::Capacity | Kind::Generation(_) | Kind::Macro(_) => 1,
        Kind::Time(_) | Kind::Action(_) | Kind::Process(_) => 0,
    }
}

/// What init sets: the sets as they are with the tokens at the start.
pub(super) fn start(out: &mut String, net: &NetBody<'_, '_, '_>) {
    let n = net.net.boxes.len();
    let (readied, driven) = (&net.layout.facts.readied, &net.layout.facts.driven);
    let (mut ready, mut waiting) = (vec![0_u32; net.net.gates.len().div_ceil(32)], vec![0_u32; n.div_ceil(32)]);
    let mut shown = waiting.clone();
    let mut drives = vec![0; net.layout.facts.levels.len()];
    for (i, _) in net.net.gates.iter().enumerate().filter(|(_, gate)| gate.before.is_empty()) {
        ready[i / 32] |= 1 << (i % 32);
    }
    let mut open = vec![0_u32; ready.len()];
    for (i, literal) in net.layout.facts.literals.iter().enumerate() {
        if literal.is_none_or(|literal| !literal.truth) {
            open[i / 32] |= 1 << (i % 32);
        }
    }
    for (i, place) in net.net.boxes.iter().enumerate() {
        let (set, bit) = (i / 32, 1 << (i % 32));
        if place.initial > 0 {
            shown[set] |= bit;
            driven[i].iter().for_each(|level| drives[*level] += 1);
        }
        if generates(place) || (place.initial > 0 && waits(place)) {
            waiting[set] |= bit;
        }
        if !waits(place) && place.initial >= full(net.net, i) {
            readied[i].iter().for_each(|(set, gates)| ready[*set] |= gates);
        }
    }
    for (name, sets) in [("ready", &ready), ("open", &open), ("waiting", &waiting), ("shown", &shown)] {
        for (i, set) in sets.iter().enumerate().filter(|(_, set)| **set != 0 && net.layout.keeps(name)) {
            let _ = writeln!(out, "    self->net.{name}[{i}] = UINT32_C(0x{set:08x});");
        }
    }
    for (i, count) in drives.iter().enumerate().filter(|(_, count)| **count != 0) {
        let _ = writeln!(out, "    self->net.drives[{i}] = {count};");
    }
    if waiting.iter().any(|set| *set != 0) {
        out.push_str("    self->net.waits = 1;\n");
    }
    // Bit 1: outputs have what START says until the first scan shows the marking.
    let _ = writeln!(out, "    self->net.restless = {};", if drives.is_empty() { 1 } else { 2 });
    if net.layout.keeps("inside") {
        out.push_str("    self->net.inside = 1;\n");
    }
}

/// Writes the functions of a net.
pub(super) fn functions(out: &mut String, statics: &mut Statics, net: &NetBody<'_, '_, '_>) {
    tables(out, net);
    inputs::function(out, net);
    let mut text = String::new();
    moves::macro_functions(&mut text, net);
    waits::function(&mut text, statics, net);
    modes::functions(&mut text, net);
    boxes(&mut text, statics, net);
    gates::functions(&mut text, statics, net);
    commands::functions(&mut text, net);
    gate_phase(&mut text, statics, net);
    ends::commit(&mut text, net);
    ends::levels(&mut text, net);
    classes::fresh(out, net.body.cx.program, net.net, &net.layout.names, &text);
    tokens::next_functions(out, net, &text);
    moves::functions(out, net, &text);
    out.push_str(&text);
}

fn tables(out: &mut String, net: &NetBody<'_, '_, '_>) {
    let (tag, name) = (net.tag(), &net.body.decl.name);
    let facts = &net.layout.facts;
    let (readied, driven) = (&facts.readied, &facts.driven);
    if net.net.boxes.is_empty() {
        return;
    }
    // Boxes that only gates at once touch are looked up nowhere.
    let after = |i: usize| if facts.late[i] { readied[i].as_slice() } else { &[] };
    let drives = net.layout.keeps("drives");
    let driven_late = driven.iter().zip(&facts.late).filter(|(_, late)| **late);
    let outputs: usize = driven_late.map(|(list, _)| list.len()).sum();
    let outputs_type = if outputs <= usize::from(u16::MAX) { "uint16_t" } else { "int32_t" };
    let also = if drives { " and outputs" } else { "" };
    let _ = writeln!(
        out,
        "/* By box of {name}: the tokens that make it ready, 0 if it waits; where its gates{also} begin. */"
    );
    let _ = writeln!(out, "static const struct {{\n    {} full;\n    uint16_t gates;", full_type(net.net));
    if drives {
        let _ = writeln!(out, "    {outputs_type} outputs;");
    }
    let _ = writeln!(out, "}} {tag}_places[{}] = {{", net.net.boxes.len() + 1);
    let (mut gates, mut outputs) = (0, 0);
    let row = |out: &mut String, full: u32, gates: usize, outputs: usize| {
        let outputs = if drives { format!(", {outputs}") } else { String::new() };
        let _ = writeln!(out, "    {{{full}, {gates}{outputs}}},");
    };
    for (i, driven) in driven.iter().enumerate() {
        row(out, full(net.net, i), gates, outputs);
        gates += after(i).len();
        outputs += if facts.late[i] { driven.len() } else { 0 };
    }
    row(out, 0, gates, outputs);
    out.push_str("};\n\n");
    if gates > 0 {
        let _ = writeln!(
            out,
            "static const struct {{\n    uint32_t gates;\n    int32_t set;\n}} {tag}_after[{gates}] = {{"
        );
        for (set, gates) in (0..net.net.boxes.len()).flat_map(after) {
            let _ = writeln!(out, "    {{UINT32_C(0x{gates:08x}), {set}}},");
        }
        out.push_str("};\n\n");
    }
    if outputs > 0 {
        let late = driven.iter().zip(&facts.late).filter(|(_, late)| **late);
        let list: Vec<String> = late.flat_map(|(list, _)| list).map(usize::to_string).collect();
        let _ = writeln!(out, "static const uint16_t {tag}_drives[{outputs}] = {{{}}};\n", list.join(", "));
    }
    if net.layout.facts.driven.iter().any(|list| !list.is_empty()) {
        let _ = writeln!(out, "static const size_t {tag}_outputs[{}] = {{", net.layout.facts.levels.len());
        let scope = Scope { unit: net.body.id, root: "", part: WHOLE };
        for word in &net.layout.facts.levels {
            let _ = writeln!(out, "    offsetof(struct {tag}, {}),", net.word(*word, scope));
        }
        out.push_str("};\n\n");
    }
}

/// What is not 0 where something may happen in a scan although no input changed. `root` stands before members.
pub(super) fn awake(layout: &NetLayout, root: &str) -> Vec<String> {
    let mut awake = vec![format!("{root}net.restless")];
    awake.extend(layout.keeps("waits").then(|| format!("{root}net.waits")));
    awake.extend(layout.keeps("inside").then(|| format!("{root}net.inside")));
    awake
}

fn boxes(out: &mut String, statics: &mut Statics, net: &NetBody<'_, '_, '_>) {
    let tag = net.tag();
    let _ = writeln!(
        out,
        "/* Begins a scan: inputs of nets inside, the box phase. Tells whether the gates need be tried. */"
    );
    let _ = writeln!(out, "static int32_t {tag}_boxes(struct {tag} *self, int32_t changed)\n{{");
    let keeps = |name: &str| net.layout.keeps(name);
    let mut tests = vec!["changed".to_owned()];
    tests.extend(awake(net.layout, "self->"));
    let mut begin = String::new();
    modes::begin(&mut begin, net);
    let _ = write!(
        out,
        "    self->status = 0;
{begin}    if (({}) == 0) {{
        self->net.go = 0;
        return 0;
    }}
    int32_t happened = changed | self->net.restless;
    self->net.restless = {};
",
        tests.join(" | "),
        i32::from(net.layout.facts.ticking)
    );
    if keeps("wrote") {
        out.push_str("    memset(self->net.wrote, 0, sizeof self->net.wrote);\n");
    }
    if keeps("waits") {
        let mut tests: Vec<String> = modes::unless(net, "PCL2_NET_STOPPED").into_iter().collect();
        tests.push("self->net.waits".to_owned());
        let _ = writeln!(out, "    if ({}) {{\n        happened |= {tag}_wait(self);\n    }}", tests.join(" && "));
    }
    for (part, _, layout) in net.parts() {
        let member = member(net, part);
        modes::hand_down(out, net, part);
        let inputs = statements::part_inputs(statics, net, part);
        if inputs.is_empty() {
            let _ = writeln!(out, "    happened |= {}_boxes(&self->{member}, 0);", layout.tag);
            continue;
        }
        let statement = net.net.parts[part].statement;
        statements::comment(out, INDENT, statements::source(net, statement));
        tokens::lend(out, net, statement, &tokens::lenders(net, statement, &[]), INDENT);
        let ports = inputs.iter().take(layout.ports.len());
        let arguments: Vec<&str> = ports.map(|input| input.from.as_str()).collect();
        let arguments = arguments.join(", ");
        let _ = writeln!(out, "    changed = {}_inputs(&self->{member}, {arguments});", layout.tag);
        let _ = writeln!(out, "    happened |= {}_boxes(&self->{member}, changed);", layout.tag);
    }
    out.push_str("    self->net.go = happened;\n    return happened;\n}\n\n");
}

fn gate_phase(out: &mut String, statics: &mut Statics, net: &NetBody<'_, '_, '_>) {
    let tag = net.tag();
    let moded = net.layout.keeps("mode");
    if moded {
        let _ = writeln!(out, "/* Tries the gates. */\nstatic void {tag}_try(struct {tag} *self)\n{{");
        let start = out.len();
        tries(out, statics, net);
        out.push_str(if out.len() == start { "    (void)self;\n" } else { "" });
        out.push_str("}\n\n");
    }
    let _ = writeln!(out, "/* The gate phase. */\nstatic void {tag}_gates(struct {tag} *self)\n{{");
    out.push_str("    if (!self->net.go) {\n        return;\n    }\n");
    if moded {
        let _ = writeln!(out, "    if (self->net.mode == PCL2_NET_AUTOMATIC) {{\n        {tag}_try(self);\n    }}");
    } else {
        tries(out, statics, net);
    }
    if commands::obeys(net) {
        let _ = writeln!(out, "    if (self->net.mode == PCL2_NET_MANUAL) {{\n        {tag}_obey(self);\n    }}");
    }
    for (part, _, layout) in net.parts() {
        let member = member(net, part);
        if let Some(place) = net.net.parts[part].place
            && layout.net.as_ref().is_some_and(|inner| inner.keeps("within"))
        {
            let _ = writeln!(out, "    self->{member}.net.within = {} > 0 ? 2 : 1;", net.left(place));
        }
        let _ = writeln!(out, "    {}_gates(&self->{member});", layout.tag);
    }
    out.push_str("}\n\n");
}

/// Writes how ABORT lines and gates are tried.
fn tries(out: &mut String, statics: &mut Statics, net: &NetBody<'_, '_, '_>) {
    for (part, _, _) in net.parts() {
        abort(out, statics, net, part);
    }
    try_gates(out, net);
}

/// Tries the gates that are ready when the phase begins.
fn try_gates(out: &mut String, net: &NetBody<'_, '_, '_>) {
    let sets = net.net.gates.len().div_ceil(gates::GATES);
    if sets == 0 {
        return;
    }
    if net.layout.keeps("begun") {
        out.push_str("    /* Gates whose first box is marked now: a token that is taken at once leaves no room in this scan. */\n");
    }
    for set in (0..sets).filter(|set| net.layout.facts.begun.iter().flatten().any(|(begun, _)| begun == set)) {
        let _ = writeln!(out, "    self->net.begun[{set}] = self->net.ready[{set}];");
    }
    for set in 0..sets {
        let open = if net.layout.keeps("open") { format!(" & self->net.open[{set}]") } else { String::new() };
        let _ = writeln!(out, "    const uint32_t ready_{} = self->net.ready[{set}]{open};", set + 1);
    }
    let forced = if commands::fires(net) { ", 0" } else { "" };
    out.push_str("    int32_t fired = 0;\n");
    for word in 1..=sets {
        let tag = net.tag();
        let _ = writeln!(
            out,
            "    if (ready_{word} != 0) {{\n        fired |= {tag}_gates_{word}(self, ready_{word}{forced});\n    }}"
        );
    }
    out.push_str("    self->net.restless |= fired;\n");
}

fn abort(out: &mut String, statics: &mut Statics, net: &NetBody<'_, '_, '_>, part: usize) {
    let (Some(abort), Some(place)) = (&net.net.parts[part].abort, net.net.parts[part].place) else {
        return;
    };
    let name = net.place(place);
    let _ = writeln!(out, "    /* ABORT of {} */\n    if ({} > 0) {{", net.net.parts[part].name, net.left(place));
    let condition = tokens::condition(out, statics, net, abort.condition, &[], "        ");
    let mut tests = vec![condition];
    tests.extend(gates::box_room(net, abort.to, 1));
    let _ = writeln!(out, "        if ({}) {{", tests.join(" && "));
    let inner = "            ";
    for word in &abort.clears {
        let _ = writeln!(out, "{inner}{} = 0;", net.word(word.0 as usize, net.scope()));
    }
    tokens::take(out, net, place, &[], inner);
    let _ = writeln!(out, "{inner}{}_empty(&self->{});", part_tag(net, part), member(net, part));
    let _ = writeln!(out, "{inner}self->net.taken[{name}] = 1;\n{inner}{}_touch(self, {name});", net.tag());
    for statement in &abort.actions {
        firing::run(out, statics, net, *statement, ("0", &[(place, Held::OnItsWay)]), inner);
    }
    firing::put(out, net, &pcl2_lang::net::Arc { place: abort.to, weight: 1 }, place, (1, "0"), inner);
    let _ = writeln!(out, "{inner}self->net.restless = 1;\n        }}\n    }}");
}

/// Writes the function of a scan of an instance whose inputs are there.
pub(super) fn scan(out: &mut String, net: &NetBody<'_, '_, '_>) {
    let tag = net.tag();
    let _ = write!(
        out,
        "/* A scan of {}: its inputs are there. */
static void {tag}_scan(struct {tag} *self, int32_t changed)
{{
    if ({tag}_boxes(self, changed)) {{
        {tag}_gates(self);
        {tag}_commit(self);
        {tag}_levels(self);
    }}
",
        net.body.decl.name
    );
    passes(out, net);
    out.push_str("}\n\n");
    if net.layout.top {
        let _ = writeln!(out, "/* A scan in which nothing can happen. */");
        let _ = writeln!(out, "static inline void {tag}_pass(struct {tag} *self)\n{{\n    self->status = 0;");
        passes(out, net);
        out.push_str("}\n\n");
    }
}

/// Writes what each scan ends with.
fn passes(out: &mut String, net: &NetBody<'_, '_, '_>) {
    if ends::active_apart(net) {
        let _ = writeln!(out, "    {}_active(self);", net.tag());
    }
    match (net.layout.keeps("clock"), net.net.operation.is_some()) {
        (true, true) => out.push_str("    self->net.clock += self->net.period;\n"),
        (true, false) => {
            out.push_str("    self->net.clock += self->net.period;\n    self->net.now = self->net.clock;\n");
        }
        (false, _) if net.layout.timed => out.push_str("    self->net.now += self->net.period;\n"),
        (false, _) => {}
    }
}
