//! The fast form: code of each gate, tried only while its first box is ready; a scan in which nothing can happen ends at
//! once.
//!
//! A scan does what that of the player does, in the same order. Between its phases stand sets of boxes and gates:
//! `ready` (gates whose first box is excited), `waiting` (boxes with something to do in the box phase), `touched` (boxes
//! that a gate took from or put into), `shown` (boxes that count among those that drive outputs).

use super::facts::{generates, waits};
use super::gates;
use super::layout::part_unit;
use super::statements;
use super::waits;
use super::{INDENT, NetBody, take_arguments};
use crate::bodies::Body;
use crate::expr::{self, Scope};
use crate::layout::WHOLE;
use crate::statics::Statics;
use pcl2_lang::net::{BoxId, Drive, Kind, Level, Net, PartId};
use pcl2_lang::program::{Role, SignalId};
use pcl2_lang::types::Type;
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

fn is_macro(net: &NetBody<'_, '_, '_>, part: usize) -> bool {
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
    for (i, gate) in net.net.gates.iter().enumerate().filter(|(_, gate)| gate.before.is_empty()) {
        let _ = gate;
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
    inputs(out, net);
    let mut text = String::new();
    macro_functions(&mut text, net);
    waits::function(&mut text, statics, net);
    boxes(&mut text, statics, net);
    gates::functions(&mut text, statics, net);
    gate_phase(&mut text, statics, net);
    commit(&mut text, net);
    levels(&mut text, net);
    moves(out, net, &text);
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
    let also = if drives { " and outputs" } else { "" };
    let _ = writeln!(
        out,
        "/* By box of {name}: the tokens that make it ready, 0 if it waits; where its gates{also} begin. */"
    );
    let _ = writeln!(out, "static const struct {{\n    {} full;\n    uint16_t gates;", full_type(net.net));
    out.push_str(if drives { "    uint16_t outputs;\n" } else { "" });
    let _ = writeln!(out, "}} {tag}_places[{}] = {{", net.net.boxes.len() + 1);
    let (mut gates, mut outputs) = (0, 0);
    for i in 0..=net.net.boxes.len() {
        let known = i < net.net.boxes.len();
        let _ = write!(out, "    {{{}, {gates}", if known { full(net.net, i) } else { 0 });
        let _ = if drives { writeln!(out, ", {outputs}}},") } else { writeln!(out, "}},") };
        if known {
            gates += after(i).len();
            outputs += driven.get(i).map_or(0, Vec::len);
        }
    }
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
        let list: Vec<String> = driven.iter().flatten().map(usize::to_string).collect();
        let _ = writeln!(out, "static const uint16_t {tag}_drives[{outputs}] = {{{}}};\n", list.join(", "));
        let _ = writeln!(out, "static const size_t {tag}_outputs[{}] = {{", net.layout.facts.levels.len());
        let scope = Scope { unit: net.body.id, root: "", part: WHOLE };
        for word in &net.layout.facts.levels {
            let _ = writeln!(out, "    offsetof(struct {tag}, {}),", net.word(*word, scope));
        }
        out.push_str("};\n\n");
    }
}

/// Whether no box that is looked up is the first one of a gate.
fn no_gates(net: &NetBody<'_, '_, '_>) -> bool {
    let facts = &net.layout.facts;
    facts.readied.iter().zip(&facts.late).all(|(gates, late)| gates.is_empty() || !late)
}

/// Writes those of the small functions that the functions of gates and boxes use.
fn moves(out: &mut String, net: &NetBody<'_, '_, '_>, users: &str) {
    let tag = net.tag();
    let used = |name: &str| users.contains(&format!(" {tag}_{name}("));
    for (name, change, says) in [
        ("excite", "|= ", "The gates after a box are ready."),
        ("calm", "&= ~", "The gates after a box are not ready."),
    ] {
        if used(name) {
            let _ =
                writeln!(out, "/* {says} */\nstatic inline void {tag}_{name}(struct {tag} *self, int32_t place)\n{{");
            change_ready(out, net, change);
        }
    }
    if used("take") {
        let _ = write!(
            out,
            "/* Tokens leave a box at the end of the gate phase. */
static inline void {tag}_take(struct {tag} *self, int32_t place, int32_t tokens)
{{
    self->net.taken[place] += tokens;
    pcl2_net_add(self->net.touched, place);
}}

"
        );
    }
    if used("put") {
        put(out, net);
    }
    if net.layout.facts.tracks() {
        let _ = write!(
            out,
            "/* Who wrote an output. */
static inline struct pcl2_net_writes {tag}_writes(struct {tag} *self, int32_t output)
{{
    const struct pcl2_net_writes writes = {{&self->net.wrote[output], &self->status, &self->net.conflicts}};
    return writes;
}}

"
        );
    }
}

fn change_ready(out: &mut String, net: &NetBody<'_, '_, '_>, change: &str) {
    if no_gates(net) {
        out.push_str("    (void)self;\n    (void)place;\n}\n\n");
        return;
    }
    let tag = net.tag();
    let _ = writeln!(out, "    for (int32_t i = {tag}_places[place].gates; i < {tag}_places[place + 1].gates; i++) {{");
    let _ = writeln!(out, "        self->net.ready[{tag}_after[i].set] {change}{tag}_after[i].gates;\n    }}\n}}\n");
}

fn put(out: &mut String, net: &NetBody<'_, '_, '_>) {
    let tag = net.tag();
    let _ = write!(
        out,
        "/* Tokens come into a box at the end of the gate phase. */
static inline void {tag}_put(struct {tag} *self, int32_t place, int32_t tokens"
    );
    let (used, by) = (net.layout.keeps("used"), net.layout.keeps("by"));
    out.push_str(if used { ", int32_t room" } else { "" });
    out.push_str(if by { ", int32_t gate" } else { "" });
    out.push_str(")\n{\n");
    // Only a box without a limit can get more tokens than an int holds.
    let unlimited = net.net.boxes.iter().any(|place| place.capacity.is_none());
    for (member, tokens) in
        [("filled", "tokens"), ("used", "room")].into_iter().filter(|(name, _)| net.layout.keeps(name))
    {
        let _ = if unlimited {
            writeln!(out, "    self->net.{member}[place] = pcl2_add_i(self->net.{member}[place], {tokens});")
        } else {
            writeln!(out, "    self->net.{member}[place] += {tokens};")
        };
    }
    out.push_str(if by { "    self->net.by[place] = gate;\n" } else { "" });
    out.push_str("    pcl2_net_add(self->net.touched, place);\n}\n\n");
}

/// Writes what the net around a macro calls.
fn macro_functions(out: &mut String, net: &NetBody<'_, '_, '_>) {
    let (Some(entry), Some(exit)) = (net.net.entry, net.net.exit) else {
        return;
    };
    let (tag, n) = (net.tag(), net.net.boxes.len());
    let (entry, exit) = (net.place(entry), net.place(exit));
    let moves = net.layout.moves;
    let room = if net.layout.keeps("used") { ", 1" } else { "" };
    let by = if net.layout.keeps("by") { ", 0" } else { "" };
    if moves.asked {
        let _ = write!(
            out,
            "/* Whether nothing is marked, so that a token may enter. */
static inline int32_t {tag}_vacant(const struct {tag} *self)
{{
    int32_t tokens = 0;
    for (int32_t place = 0; place < {n}; place++) {{
        tokens |= self->box[place] | self->net.filled[place];
    }}
    return tokens == 0;
}}

"
        );
    }
    if moves.entered {
        let _ = write!(
            out,
            "/* A token enters. */
static inline void {tag}_enter(struct {tag} *self)
{{
    {tag}_put(self, {entry}, 1{room}{by});
    self->net.go = 1;
    self->net.restless = 1;
}}

"
        );
    }
    if moves.left {
        let _ = write!(
            out,
            "/* The token leaves. */
static inline void {tag}_leave(struct {tag} *self)
{{
    self->net.taken[{exit}] = self->box[{exit}];
    pcl2_net_add(self->net.touched, {exit});
    self->net.go = 1;
    self->net.restless = 1;
}}

"
        );
    }
    if moves.emptied {
        empty(out, net);
    }
}

fn empty(out: &mut String, net: &NetBody<'_, '_, '_>) {
    let (tag, n) = (net.tag(), net.net.boxes.len());
    let _ = write!(
        out,
        "/* Every token inside goes. */
static inline void {tag}_empty(struct {tag} *self)
{{
    for (int32_t place = 0; place < {n}; place++) {{
        self->net.taken[place] = self->box[place];
        pcl2_net_add(self->net.touched, place);
    }}
"
    );
    for (part, _, layout) in net.parts().filter(|(part, ..)| is_macro(net, *part)) {
        let _ = writeln!(out, "    {}_empty(&self->{});", layout.tag, member(net, part));
    }
    out.push_str("    self->net.go = 1;\n    self->net.restless = 1;\n}\n\n");
}

fn boxes(out: &mut String, statics: &mut Statics, net: &NetBody<'_, '_, '_>) {
    let tag = net.tag();
    let _ = writeln!(
        out,
        "/* Begins a scan: inputs of nets inside, the box phase. Tells whether the gates need be tried. */"
    );
    let _ = writeln!(out, "static int32_t {tag}_boxes(struct {tag} *self, int32_t changed)\n{{");
    let keeps = |name: &str| net.layout.keeps(name);
    let mut awake = vec!["changed", "self->net.restless"];
    awake.extend(keeps("waits").then_some("self->net.waits"));
    awake.extend(keeps("inside").then_some("self->net.inside"));
    let _ = write!(
        out,
        "    self->status = 0;
    if (({}) == 0) {{
        self->net.go = 0;
        return 0;
    }}
    int32_t happened = changed | self->net.restless;
    self->net.restless = {};
",
        awake.join(" | "),
        i32::from(net.layout.facts.ticking)
    );
    if keeps("wrote") {
        out.push_str("    memset(self->net.wrote, 0, sizeof self->net.wrote);\n");
    }
    if keeps("waits") {
        let _ = writeln!(out, "    if (self->net.waits) {{\n        happened |= {tag}_wait(self);\n    }}");
    }
    for (part, _, layout) in net.parts() {
        let member = member(net, part);
        if layout.net.as_ref().is_some_and(|net| net.timed) {
            let _ = writeln!(out, "    self->{member}.net.now = self->net.now;");
        }
        let inputs = statements::part_inputs(statics, net, part);
        if inputs.is_empty() {
            let _ = writeln!(out, "    happened |= {}_boxes(&self->{member}, 0);", layout.tag);
            continue;
        }
        statements::comment(out, INDENT, statements::source(net, net.net.parts[part].statement));
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
    let _ = writeln!(out, "/* The gate phase. */\nstatic void {tag}_gates(struct {tag} *self)\n{{");
    out.push_str("    if (!self->net.go) {\n        return;\n    }\n");
    for (part, _, _) in net.parts() {
        abort(out, statics, net, part);
    }
    let sets = net.net.gates.len().div_ceil(gates::GATES);
    if sets > 0 {
        let open = if net.layout.keeps("open") { " & self->net.open[set]" } else { "" };
        let _ = write!(
            out,
            "    uint32_t ready[{sets}];
    for (int32_t set = 0; set < {sets}; set++) {{
        ready[set] = self->net.ready[set]{open};
    }}
"
        );
    }
    for word in 0..sets {
        let _ = writeln!(out, "    self->net.restless |= {tag}_gates_{}(self, ready[{word}]);", word + 1);
    }
    for (part, _, layout) in net.parts() {
        let _ = writeln!(out, "    {}_gates(&self->{});", layout.tag, member(net, part));
    }
    out.push_str("}\n\n");
}

fn abort(out: &mut String, statics: &mut Statics, net: &NetBody<'_, '_, '_>, part: usize) {
    let (Some(abort), Some(place)) = (&net.net.parts[part].abort, net.net.parts[part].place) else {
        return;
    };
    let name = net.place(place);
    let _ = writeln!(out, "    /* ABORT of {} */\n    if (self->box[{name}] != 0) {{", net.net.parts[part].name);
    let condition = statements::condition(out, statics, net, abort.condition, "        ");
    let mut tests = vec![condition];
    tests.extend(gates::box_room(net, abort.to, 1));
    let _ = writeln!(out, "        if ({}) {{", tests.join(" && "));
    let inner = "            ";
    let _ = writeln!(out, "{inner}{}_empty(&self->{});", part_tag(net, part), member(net, part));
    let _ = writeln!(out, "{inner}self->net.taken[{name}] = 1;\n{inner}pcl2_net_add(self->net.touched, {name});");
    for statement in &abort.actions {
        gates::run(out, statics, net, *statement, "0", inner);
    }
    gates::put(out, net, &pcl2_lang::net::Arc { place: abort.to, weight: 1 }, 1, "0", inner);
    let _ = writeln!(out, "{inner}self->net.restless = 1;\n        }}\n    }}");
}

fn commit(out: &mut String, net: &NetBody<'_, '_, '_>) {
    let tag = net.tag();
    let keeps = |name: &str| net.layout.keeps(name);
    let _ = writeln!(
        out,
        "/* The end of the gate phase: tokens leave and come. */\nstatic void {tag}_commit(struct {tag} *self)\n{{"
    );
    out.push_str("    if (!self->net.go) {\n        return;\n    }\n");
    for (part, _, layout) in net.parts() {
        let _ = writeln!(out, "    {}_commit(&self->{});", layout.tag, member(net, part));
    }
    if !net.net.boxes.is_empty() {
        let sets = net.net.boxes.len().div_ceil(32);
        let _ = write!(
            out,
            "    for (int32_t set = 0; set < {sets}; set++) {{
        uint32_t boxes = self->net.touched[set];
        self->net.touched[set] = 0;
        while (boxes != 0) {{
            const int32_t place = 32 * set + pcl2_net_lowest(boxes);
            boxes &= boxes - 1;
            const int32_t filled = self->net.filled[place];
            self->box[place] = pcl2_add_i(self->box[place], filled - self->net.taken[place]);
            self->net.filled[place] = 0;
            self->net.taken[place] = 0;
"
        );
        out.push_str(if keeps("used") { "            self->net.used[place] = 0;\n" } else { "" });
        let waits = begin_wait(out, net);
        let _ = write!(
            out,
            "{}if (self->box[place] >= {tag}_places[place].full) {{
                {tag}_excite(self, place);
            }} else {{
                {tag}_calm(self, place);
            }}
",
            if waits { " else " } else { "            " }
        );
        if keeps("drives") {
            show(out, net);
        }
        out.push_str("        }\n    }\n");
    }
    if keeps("inside") {
        out.push_str("    self->net.inside = 0;\n");
        for (part, _, layout) in net.parts() {
            let inner = member(net, part);
            let keeps = |name: &str| layout.net.as_ref().is_some_and(|net| net.keeps(name));
            let mut awake = vec![format!("self->{inner}.net.restless")];
            awake.extend(keeps("waits").then(|| format!("self->{inner}.net.waits")));
            awake.extend(keeps("inside").then(|| format!("self->{inner}.net.inside")));
            let _ = writeln!(out, "    self->net.restless |= self->{inner}.net.restless;");
            let _ = writeln!(out, "    self->net.inside |= {};", awake.join(" | "));
        }
    }
    out.push_str("}\n\n");
}

/// Boxes that wait begin to when a token comes; one that is empty waits no more. Tells whether there are any.
fn begin_wait(out: &mut String, net: &NetBody<'_, '_, '_>) -> bool {
    if !net.net.boxes.iter().any(waits) {
        return false;
    }
    let tag = net.tag();
    let by = if net.layout.keeps("by") { "self->net.by[place] << 2" } else { "0" };
    let _ = writeln!(out, "            if ({tag}_places[place].full == 0) {{");
    out.push_str("                if (filled != 0) {\n");
    if net.layout.keeps("since") {
        out.push_str("                    self->net.since[place] = self->net.now;\n");
    }
    let _ = write!(
        out,
        "                    self->net.phase[place] = {by};
                    pcl2_net_add(self->net.waiting, place);
                    self->net.waits = 1;
                    {tag}_calm(self, place);
                }} else if (self->box[place] == 0) {{
                    pcl2_net_remove(self->net.waiting, place);
                    {tag}_calm(self, place);
                }}
            }}"
    );
    true
}

fn show(out: &mut String, net: &NetBody<'_, '_, '_>) {
    let tag = net.tag();
    let any = net.layout.facts.driven.iter().any(|list| !list.is_empty());
    if !any {
        return;
    }
    let _ = write!(
        out,
        "            const int32_t marked = self->box[place] > 0;
            if (marked != pcl2_net_in(self->net.shown, place)) {{
                self->net.shown[set] ^= UINT32_C(1) << (place & 31);
                self->net.restless = 1;
                for (int32_t i = {tag}_places[place].outputs; i < {tag}_places[place + 1].outputs; i++) {{
                    const int32_t output = {tag}_drives[i];
                    self->net.drives[output] += marked ? 1 : -1;
                    *(int32_t *)(void *)((char *)self + {tag}_outputs[output]) = self->net.drives[output] > 0;
                }}
            }}
"
    );
}

fn levels(out: &mut String, net: &NetBody<'_, '_, '_>) {
    let tag = net.tag();
    let _ = writeln!(out, "/* The end of a scan: outputs that follow from nets inside and from the marking. */");
    let _ = writeln!(
        out,
        "static void {tag}_levels(struct {tag} *self)\n{{\n    if (!self->net.go) {{\n        return;\n    }}"
    );
    let parts: Vec<_> = net.parts().collect();
    for (part, _, layout) in parts.iter().rev() {
        let inner = member(net, *part);
        let _ = writeln!(out, "    {}_levels(&self->{inner});", layout.tag);
        let _ = writeln!(out, "    pcl2_net_fault(&self->status, self->{inner}.status);");
    }
    for (part, _, _) in &parts {
        part_writes(out, net, *part);
    }
    if net.layout.facts.driven.iter().any(|list| !list.is_empty()) {
        let n = net.layout.facts.levels.len();
        let _ = write!(
            out,
            "    for (int32_t output = 0; (self->net.go & 2) != 0 && output < {n}; output++) {{
        *(int32_t *)(void *)((char *)self + {tag}_outputs[output]) = self->net.drives[output] > 0;
        self->net.restless = 1;
    }}
"
        );
    }
    for (level, word) in net.layout.facts.levels.iter().enumerate() {
        joined(out, net, level, *word);
    }
    if !net.net.actives.is_empty() && !active_apart(net) {
        let _ = writeln!(out, "    {tag}_active(self);");
    }
    out.push_str("}\n\n");
    if !net.net.actives.is_empty() {
        let at = out.rfind("/* The end of a scan:").unwrap_or(out.len());
        let mut text = String::new();
        active(&mut text, net);
        out.insert_str(at, &text);
    }
}

/// A word of a net inside, seen from here.
fn part_word(net: &NetBody<'_, '_, '_>, part: usize, output: usize) -> String {
    let inner = inner(net, part);
    let Some(inside) = inner.as_ref().and_then(NetBody::of) else {
        return String::new();
    };
    let root = format!("self->{}.", member(net, part));
    let scope = Scope { unit: inside.body.id, root: &root, part: WHOLE };
    inside.word(output, scope)
}

/// Words that a net inside writes take its value when it wrote it.
fn part_writes(out: &mut String, net: &NetBody<'_, '_, '_>, part: usize) {
    for (output, word) in &net.net.parts[part].writes {
        let (output, word) = (*output as usize, word.0 as usize);
        let (inner, place) = (member(net, part), net.word(word, net.scope()));
        let ty = pcl2_lang::kernel::c_scalar(net.net.words[word].scalar);
        let _ = writeln!(out, "    if (self->{inner}.net.go && self->{inner}.net.wrote[{output}] != 0) {{");
        if net.layout.facts.tracked[word] {
            let _ = writeln!(out, "        const {ty} before = {place};");
        }
        let _ = writeln!(out, "        {place} = {};", part_word(net, part, output));
        if net.layout.facts.tracked[word] {
            gates::wrote(out, net, word, &part.to_string(), "before", "        ");
        }
        out.push_str("        self->net.restless = 1;\n    }\n");
    }
}

/// An output that nets inside drive, and perhaps boxes.
fn joined(out: &mut String, net: &NetBody<'_, '_, '_>, level: usize, word: usize) {
    let Drive::Level(levels) = &net.net.words[word].drive else {
        return;
    };
    let mut drivers: Vec<String> = Vec::new();
    for item in levels {
        match item {
            Level::Box(_) => {}
            Level::Part(part, output) => {
                drivers.push(format!("{} != 0", part_word(net, part.0 as usize, *output as usize)));
            }
        }
    }
    if drivers.is_empty() {
        return;
    }
    if levels.iter().any(|item| matches!(item, Level::Box(_))) {
        drivers.insert(0, format!("self->net.drives[{level}] > 0"));
    }
    let _ = writeln!(out, "    {} = {};", net.word(word, net.scope()), drivers.join(" || "));
}

/// Whether the times of ACTIVE lines go on in scans in which nothing else happens.
fn active_apart(net: &NetBody<'_, '_, '_>) -> bool {
    net.net.actives.iter().any(|active| active.time.is_some()) && !net.layout.facts.ticking
}

fn active(out: &mut String, net: &NetBody<'_, '_, '_>) {
    let tag = net.tag();
    let _ = writeln!(
        out,
        "/* Which boxes are marked, and for how long. */\nstatic void {tag}_active(struct {tag} *self)\n{{"
    );
    for (i, active) in net.net.actives.iter().enumerate() {
        let step = net.word(active.step.0 as usize, net.scope());
        let tests = active.boxes.iter().enumerate();
        let text: String =
            tests.map(|(k, place)| format!("self->box[{}] > 0 ? {} : ", net.place(*place), k + 1)).collect();
        let tracked = |word: usize| net.layout.facts.tracked[word];
        let _ = writeln!(out, "    const int32_t marked{i} = {text}0;");
        let _ =
            writeln!(out, "    if (marked{i} != self->net.active[{i}]) {{\n        self->net.active[{i}] = marked{i};");
        if net.layout.timed {
            let _ = writeln!(out, "        self->net.active_since[{i}] = self->net.now;");
        }
        if tracked(active.step.0 as usize) {
            let _ = writeln!(out, "        pcl2_net_counted(&self->net.wrote[{}]);", active.step.0);
        }
        let _ = writeln!(out, "    }}\n    {step} = marked{i};");
        if let Some(time) = active.time {
            if tracked(time.0 as usize) {
                let _ = writeln!(out, "    pcl2_net_counted(&self->net.wrote[{}]);", time.0);
            }
            let word = net.word(time.0 as usize, net.scope());
            let _ = writeln!(out, "    {word} = pcl2_seconds(self->net.now - self->net.active_since[{i}]);");
        }
    }
    out.push_str("}\n\n");
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
    if active_apart(net) {
        let _ = writeln!(out, "    {tag}_active(self);");
    }
    if net.layout.timed {
        out.push_str("    self->net.now += self->net.period;\n");
    }
    out.push_str("}\n\n");
}

/// Writes a scan: the arguments are the inputs.
pub(super) fn take_and_scan(out: &mut String, net: &NetBody<'_, '_, '_>) {
    let tag = net.tag();
    let arguments: Vec<&str> = net.body.layout.ports.iter().map(|(name, _)| name.as_str()).collect();
    let _ = match changes(net).is_empty() {
        true => writeln!(out, "    {tag}_scan(self, 0);"),
        false => writeln!(out, "    {tag}_scan(self, {tag}_inputs(self, {}));", arguments.join(", ")),
    };
}

/// Writes the function that takes inputs in.
fn inputs(out: &mut String, net: &NetBody<'_, '_, '_>) {
    if changes(net).is_empty() {
        return;
    }
    let tag = net.tag();
    let _ = write!(
        out,
        "/* Takes inputs in. Tells whether one changed. */\nstatic int32_t {tag}_inputs(struct {tag} *self"
    );
    for (name, ty) in &net.body.layout.ports {
        let element = pcl2_lang::kernel::c_scalar(ty.scalar);
        let _ =
            if ty.is_scalar() { write!(out, ", {element} {name}") } else { write!(out, ", const {element} *{name}") };
    }
    out.push_str(")\n{\n");
    take_changed(out, net);
    out.push_str("    return changed != 0;\n}\n\n");
}

/// Writes how inputs are taken in if one changed: they stay until the next scan. Gates that wait for an input are open
/// or not from then on.
fn take_changed(out: &mut String, net: &NetBody<'_, '_, '_>) {
    let _ = writeln!(out, "    const int32_t changed =\n        {};", changes(net).join(" |\n        "));
    out.push_str("    if (changed) {\n");
    for (i, signal) in net.body.unit.signals.iter().enumerate() {
        if let Role::Port(port) = signal.role {
            open(out, net, SignalId(i as u32), port);
        }
    }
    take_arguments(out, net, "        ");
    out.push_str("    }\n");
}

/// Gates that wait for an input, or for its opposite, change sides with it.
fn open(out: &mut String, net: &NetBody<'_, '_, '_>, input: SignalId, port: u32) {
    let mut sets: Vec<(usize, u32)> = Vec::new();
    for gate in net.layout.facts.waiting_for(input) {
        let (set, bit) = (gate / gates::GATES, 1 << (gate % gates::GATES));
        match sets.last_mut().filter(|(known, _)| *known == set) {
            Some((_, gates)) => *gates |= bit,
            None => sets.push((set, bit)),
        }
    }
    if sets.is_empty() {
        return;
    }
    let mut place = String::new();
    expr::signal_base(&mut place, net.body.cx, net.scope(), input);
    let argument = &net.body.layout.ports[port as usize].0;
    let _ = writeln!(out, "        if (({argument} != 0) != ({place} != 0)) {{");
    for (set, gates) in sets {
        let _ = writeln!(out, "            self->net.open[{set}] ^= UINT32_C(0x{gates:08x});");
    }
    out.push_str("        }\n");
}

/// What tells that an input differs from the last scan's.
fn changes(net: &NetBody<'_, '_, '_>) -> Vec<String> {
    let mut changes = Vec::new();
    let port_name = |port: u32| &net.body.layout.ports[port as usize].0;
    for (i, signal) in net.body.unit.signals.iter().enumerate() {
        let Role::Port(port) = signal.role else {
            continue;
        };
        if signal.ty.elements() > 0 {
            let mut place = String::new();
            expr::signal_base(&mut place, net.body.cx, net.scope(), SignalId(i as u32));
            changes.push(statements::differs(signal.ty, &place, port_name(port)));
        }
    }
    for (port, word) in &net.net.momentary {
        let Role::Port(port) = net.body.unit.signals[*port as usize].role else {
            continue;
        };
        changes.push(statements::differs(Type::INT, &net.word(word.0 as usize, net.scope()), port_name(port)));
    }
    changes
}
