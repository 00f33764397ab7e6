//! The small functions that gates and boxes of the fast form use, and what the net around a macro calls.

use super::NetBody;
use super::fast::{is_macro, member};
use super::layout::MOVED;
use std::fmt::Write;

/// Whether no box that is looked up is the first one of a gate.
fn no_gates(net: &NetBody<'_, '_, '_>) -> bool {
    let facts = &net.layout.facts;
    facts.readied.iter().zip(&facts.late).all(|(gates, late)| gates.is_empty() || !late)
}

/// Writes those of the small functions that the functions of gates and boxes use.
pub(super) fn functions(out: &mut String, net: &NetBody<'_, '_, '_>, users: &str) {
    let tag = net.tag();
    let used = |name: &str| [" ", "[", "("].iter().any(|before| users.contains(&format!("{before}{tag}_{name}(")));
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
    if ["touch", "take", "put"].into_iter().any(used) {
        touch(out, net);
    }
    if used("take") {
        let _ = write!(
            out,
            "/* Tokens leave a box at the end of the gate phase. */
static inline void {tag}_take(struct {tag} *self, int32_t place, int32_t tokens)
{{
    self->net.taken[place] += tokens;
    {tag}_touch(self, place);
}}

"
        );
    }
    if used("put") {
        put(out, net);
    }
    if used("there") {
        let _ = write!(
            out,
            "/* The tokens of a box that can still be taken, or that came in this gate phase. */
static inline int32_t {tag}_there(const struct {tag} *self, int32_t place)
{{
    return self->box[place] - self->net.taken[place] + self->net.filled[place];
}}

"
        );
    }
    if used("hold") {
        let _ = write!(
            out,
            "/* A permissive term holds a gate back: the first of a scan is told. */
static inline void {tag}_hold(struct {tag} *self, int32_t term)
{{
    if (self->net.blocked == 0) {{
        self->net.blocked = term;
    }}
}}

"
        );
    }
    if used("writes") {
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

fn touch(out: &mut String, net: &NetBody<'_, '_, '_>) {
    let tag = net.tag();
    let _ = writeln!(
        out,
        "/* The end of the gate phase looks at a box. */\n\
         static inline void {tag}_touch(struct {tag} *self, int32_t place)\n{{\n    \
         pcl2_net_add(self->net.touched, place);"
    );
    if net.layout.keeps(MOVED) {
        let _ = writeln!(out, "    self->net.{MOVED} |= UINT32_C(1) << (place >> 5);");
    }
    out.push_str("}\n\n");
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
    let _ = writeln!(out, "    {tag}_touch(self, place);\n}}\n");
}

/// Writes what the net around a macro calls.
pub(super) fn macro_functions(out: &mut String, net: &NetBody<'_, '_, '_>) {
    let (Some(entry), Some(exit)) = (net.net.entry, net.net.exit) else {
        return;
    };
    let (tag, n) = (net.tag(), net.net.boxes.len());
    let (entry, exit) = (net.place(entry), net.place(exit));
    let moves = net.layout.moves;
    let macros = net.parts().filter(|(part, ..)| is_macro(net, *part));
    let vacant = |(part, _, layout): (usize, _, &crate::layout::UnitLayout<'_>)| {
        format!(" && {}_vacant(&self->{})", layout.tag, member(net, part))
    };
    let inside: String = macros.map(vacant).collect();
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
    return tokens == 0{inside};
}}

"
        );
    }
    if moves.looped {
        let _ = write!(
            out,
            "/* Whether nothing but the exit is marked, so that a token may enter when that one leaves. */
static inline int32_t {tag}_vacant_but_exit(const struct {tag} *self)
{{
    int32_t tokens = 0;
    for (int32_t place = 0; place < {n}; place++) {{
        tokens |= (place == {exit} ? 0 : self->box[place]) | self->net.filled[place];
    }}
    return tokens == 0{inside};
}}

"
        );
    }
    if moves.entered || moves.left || moves.emptied {
        wake(out, net);
    }
    if moves.entered {
        let _ = write!(
            out,
            "/* A token enters. */
static inline void {tag}_enter(struct {tag} *self)
{{
    {tag}_wake(self);
    {tag}_put(self, {entry}, 1{room}{by});
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
    {tag}_wake(self);
    self->net.taken[{exit}] = self->box[{exit}];
    {tag}_touch(self, {exit});
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
    {tag}_wake(self);
    for (int32_t place = 0; place < {n}; place++) {{
        self->net.taken[place] = self->box[place];
        {tag}_touch(self, place);
    }}
"
    );
    for (part, _, layout) in net.parts().filter(|(part, ..)| is_macro(net, *part)) {
        let _ = writeln!(out, "    {}_empty(&self->{});", layout.tag, member(net, part));
    }
    out.push_str("}\n\n");
}

/// Writes how a net goes on that had nothing to do in this scan: what it told in the last one is over.
fn wake(out: &mut String, net: &NetBody<'_, '_, '_>) {
    let tag = net.tag();
    let mut over = String::new();
    if net.layout.keeps("wrote") {
        over.push_str("        memset(self->net.wrote, 0, sizeof self->net.wrote);\n");
    }
    for (part, ..) in net.parts() {
        let inner = member(net, part);
        let _ = writeln!(over, "        self->{inner}.status = 0;\n        self->{inner}.net.go = 0;");
    }
    let _ = writeln!(
        out,
        "/* The net around it moves a token: there is something to do in this scan. */
static inline void {tag}_wake(struct {tag} *self)\n{{"
    );
    if !over.is_empty() {
        let _ = writeln!(out, "    if (!self->net.go) {{\n{over}    }}");
    }
    out.push_str("    self->net.go |= 1;\n    self->net.restless |= 1;\n}\n\n");
}
