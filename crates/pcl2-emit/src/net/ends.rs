//! The end of a scan in the fast form: tokens come and go, outputs follow.

use super::facts::waits;
use super::fast::{awake, inner, member};
use super::layout::MOVED;
use super::{NetBody, firing, modes};
use crate::expr::Scope;
use crate::layout::WHOLE;
use pcl2_lang::net::{BoxId, Drive, Level};
use std::fmt::Write;

pub(super) fn commit(out: &mut String, net: &NetBody<'_, '_, '_>) {
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
        touched_sets(out, net);
        let _ = write!(
            out,
            "        uint32_t boxes = self->net.touched[set];
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
        if keeps("shown") {
            show(out, net);
        }
        out.push_str("        }\n    }\n");
    }
    if keeps("outputs") {
        outputs(out, net);
    }
    out.push_str("}\n\n");
}

/// A net inside that is awake keeps this one awake.
fn stay_awake(out: &mut String, net: &NetBody<'_, '_, '_>) {
    if !net.layout.keeps("inside") {
        return;
    }
    out.push_str("    self->net.inside = 0;\n");
    for (part, _, layout) in net.parts() {
        let inner = member(net, part);
        let awake = layout.net.as_ref().map_or_else(Vec::new, |net| awake(net, &format!("self->{inner}.")));
        let _ = writeln!(out, "    self->net.restless |= self->{inner}.net.restless;");
        let _ = writeln!(out, "    self->net.inside |= {};", awake.join(" | "));
    }
}

/// Begins a loop over the sets of touched boxes.
fn touched_sets(out: &mut String, net: &NetBody<'_, '_, '_>) {
    if !net.layout.keeps(MOVED) {
        let sets = net.net.boxes.len().div_ceil(32);
        let _ = writeln!(out, "    for (int32_t set = 0; set < {sets}; set++) {{");
        return;
    }
    let _ = write!(
        out,
        "    uint32_t moved = self->net.{MOVED};
    self->net.{MOVED} = 0;
    while (moved != 0) {{
        const int32_t set = pcl2_net_lowest(moved);
        moved &= moved - 1;
"
    );
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

/// Outputs whose drivers changed.
fn outputs(out: &mut String, net: &NetBody<'_, '_, '_>) {
    let (tag, sets) = (net.tag(), net.layout.facts.levels.len().div_ceil(32));
    let _ = write!(
        out,
        "    for (int32_t set = 0; set < {sets}; set++) {{
        uint32_t changed = self->net.outputs[set];
        self->net.outputs[set] = 0;
        while (changed != 0) {{
            const int32_t output = 32 * set + pcl2_net_lowest(changed);
            changed &= changed - 1;
            *(int32_t *)(void *)((char *)self + {tag}_outputs[output]) = self->net.drives[output] > 0;
        }}
    }}
"
    );
}

fn show(out: &mut String, net: &NetBody<'_, '_, '_>) {
    let tag = net.tag();
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

pub(super) fn levels(out: &mut String, net: &NetBody<'_, '_, '_>) {
    let tag = net.tag();
    if !net.net.actives.is_empty() {
        active(out, net);
    }
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
        let _ = match modes::unless(net, "PCL2_NET_STOPPED") {
            Some(unless) => writeln!(out, "    if ({unless}) {{\n        {tag}_active(self);\n    }}"),
            None => writeln!(out, "    {tag}_active(self);"),
        };
    }
    modes::end(out, net);
    stay_awake(out, net);
    out.push_str("}\n\n");
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

/// Whether an output of a net inside has a value of its own while that net is stopped.
fn stops(net: &NetBody<'_, '_, '_>, part: usize, output: usize) -> bool {
    let inner = inner(net, part);
    let operation = inner.as_ref().and_then(NetBody::of).and_then(|inside| inside.net.operation.as_ref());
    operation.is_some_and(|operation| operation.stops.iter().any(|(word, _)| word.0 as usize == output))
}

/// Words that a net inside writes take its value when it wrote it. Its gates come after those of the net around it.
fn part_writes(out: &mut String, net: &NetBody<'_, '_, '_>, part: usize) {
    for (output, word) in &net.net.parts[part].writes {
        let (output, word) = (*output as usize, word.0 as usize);
        let (inner, place) = (member(net, part), net.word(word, net.scope()));
        let ty = pcl2_lang::kernel::c_scalar(net.net.words[word].scalar);
        let mut when = format!("self->{inner}.net.go && self->{inner}.net.wrote[{output}] != 0");
        if stops(net, part, output) {
            when = format!("({when}) || self->{inner}.net.switched");
        }
        let _ = writeln!(out, "    if ({when}) {{");
        if net.layout.facts.tracked[word] {
            let _ = writeln!(out, "        const {ty} before = {place};");
        }
        let _ = writeln!(out, "        {place} = {};", part_word(net, part, output));
        if net.layout.facts.tracked[word] {
            let gate = (net.net.gates.len() + part).to_string();
            firing::wrote(out, net, word, &gate, "before", "        ");
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
pub(super) fn active_apart(net: &NetBody<'_, '_, '_>) -> bool {
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
        let test =
            |(k, place): (usize, &BoxId)| format!("self->box[{}] > 0 ? {}\n        : ", net.place(*place), k + 1);
        let text: String = tests.map(test).collect();
        let tracked = |word: usize| net.layout.facts.tracked[word];
        let _ = writeln!(out, "    const int32_t marked{i} = {text}0;");
        let _ =
            writeln!(out, "    if (marked{i} != self->net.active[{i}]) {{\n        self->net.active[{i}] = marked{i};");
        out.push_str("        self->net.restless |= 1;\n");
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
