//! The table form: the player of the runtime walks a table, and calls back for statements.

use super::NetBody;
use super::layout::{MODE_COUNTERS, STOOD};
use super::statements::{self, Use};
use crate::expr::Scope;
use crate::layout::WHOLE;
use crate::statics::Statics;
use pcl2_lang::net::StatementId;
use std::fmt::Write;

/// Words of a table on one line.
const PER_LINE: usize = 24;

/// Writes table, statements, and the function that hands an instance to the player.
pub(super) fn functions(out: &mut String, statics: &mut Statics, net: &NetBody<'_, '_, '_>) {
    words(out, net);
    places(out, net);
    let uses = statements::uses(net);
    act(out, statics, net, &uses);
    duration(out, statics, net, &uses);
    hand(out, net);
}

fn words(out: &mut String, net: &NetBody<'_, '_, '_>) {
    let words = &net.layout.table.words;
    let name = &net.body.decl.name;
    let _ = writeln!(out, "/* {name}, for the player of nets. */");
    let _ = writeln!(out, "static const pcl2_net_word {}_table[{}] = {{", net.tag(), words.len());
    for line in words.chunks(PER_LINE) {
        let line: Vec<String> = line.iter().map(i32::to_string).collect();
        let _ = writeln!(out, "    {},", line.join(", "));
    }
    out.push_str("};\n\n");
}

/// Where words and attributes of tokens in hand are.
fn places(out: &mut String, net: &NetBody<'_, '_, '_>) {
    let first_hand = net.net.words.len() + 1;
    let hands = first_hand..first_hand + net.layout.table.hands;
    for (list, signals) in [("words", 0..net.net.words.len()), ("hands", hands)] {
        if signals.is_empty() {
            continue;
        }
        let _ = writeln!(out, "static const size_t {}_{list}[{}] = {{", net.tag(), signals.len());
        for signal in signals {
            let scope = Scope { unit: net.body.id, root: "", part: WHOLE };
            let _ = writeln!(out, "    offsetof(struct {}, {}),", net.tag(), net.word(signal, scope));
        }
        out.push_str("};\n\n");
    }
}

fn open(out: &mut String, net: &NetBody<'_, '_, '_>, result: &str, name: &str) {
    let tag = net.tag();
    let _ = writeln!(out, "static {result} {tag}_{name}(const struct pcl2_net *net, int32_t statement)\n{{");
}

fn instance(out: &mut String, net: &NetBody<'_, '_, '_>, body: &str) {
    if body.contains("self->") {
        let _ = writeln!(out, "    struct {tag} *const self = (struct {tag} *)(void *)net->base;", tag = net.tag());
    } else {
        out.push_str("    (void)net;\n");
    }
}

fn act(out: &mut String, statics: &mut Statics, net: &NetBody<'_, '_, '_>, uses: &[Use]) {
    let mut cases = String::new();
    for (i, purpose) in uses.iter().enumerate() {
        let statement = StatementId(i as u32);
        let mut body = String::new();
        let indent = "        ";
        match purpose {
            Use::Time => continue,
            Use::Condition => {
                statements::comment(&mut body, indent, statements::source(net, statement));
                let value = statements::condition(&mut body, statics, net, statement, indent);
                let _ = writeln!(body, "{indent}return {value};");
            }
            Use::Inputs(part) => {
                statements::comment(&mut body, indent, statements::source(net, statement));
                statements::inputs(&mut body, statics, net, *part, indent);
                let _ = writeln!(body, "{indent}return 0;");
            }
            Use::Action => {
                statements::action(&mut body, statics, net, statement, indent);
                let _ = writeln!(body, "{indent}return 1;");
            }
        }
        let _ = write!(cases, "    case {i}: {{\n{body}    }}\n");
    }
    let _ = writeln!(out, "/* Runs a statement of {}: of a condition its truth. */", net.body.decl.name);
    open(out, net, "int32_t", "act");
    instance(out, net, &cases);
    let _ = write!(out, "    switch (statement) {{\n{cases}    default:\n        return 0;\n    }}\n}}\n\n");
}

fn duration(out: &mut String, statics: &mut Statics, net: &NetBody<'_, '_, '_>, uses: &[Use]) {
    let mut cases = String::new();
    for (i, _) in uses.iter().enumerate().filter(|(_, purpose)| **purpose == Use::Time) {
        let mut body = String::new();
        let value = statements::time(&mut body, statics, net, StatementId(i as u32), "        ");
        let _ = write!(cases, "    case {i}: {{\n{body}        return {value};\n    }}\n");
    }
    let _ = writeln!(out, "/* The value of a time of {}, in nanoseconds. */", net.body.decl.name);
    open(out, net, "int64_t", "duration");
    instance(out, net, &cases);
    if cases.is_empty() {
        out.push_str("    (void)statement;\n    return 0;\n}\n\n");
    } else {
        let _ = write!(out, "    switch (statement) {{\n{cases}    default:\n        return 0;\n    }}\n}}\n\n");
    }
}

/// Writes the function that hands an instance and those inside it to the player.
fn hand(out: &mut String, net: &NetBody<'_, '_, '_>) {
    let tag = net.tag();
    let _ = writeln!(out, "/* Hands an instance of {}, and the nets inside it, to the player. */", net.body.decl.name);
    let _ = writeln!(out, "static void {tag}_net(struct {tag} *self, struct pcl2_net *net)\n{{");
    let _ = writeln!(out, "    net->table = {tag}_table;\n    net->base = (char *)self;");
    let kept = |name: &str| net.layout.fields.iter().any(|field| field.name == name);
    let boxes = if net.net.boxes.is_empty() { "NULL" } else { "self->box" };
    let _ = writeln!(out, "    net->box = {boxes};");
    for array in
        ["taken", "filled", "used", "phase", "by", "hold", "since", "ints", "reals", "wrote", "active", "active_since"]
    {
        let _ = match kept(array) {
            true => writeln!(out, "    net->{array} = self->net.{array};"),
            false => writeln!(out, "    net->{array} = NULL;"),
        };
    }
    for (list, any) in [("words", !net.net.words.is_empty()), ("hands", net.layout.table.hands > 0)] {
        let _ = match any {
            true => writeln!(out, "    net->{list} = {tag}_{list};"),
            false => writeln!(out, "    net->{list} = NULL;"),
        };
    }
    out.push_str("    net->outer = NULL;\n    net->inputs = 0;\n    net->now = 0;\n    net->status = &self->status;\n");
    for member in [STOOD].into_iter().chain(MODE_COUNTERS) {
        let _ = match kept(member) {
            true => writeln!(out, "    net->{member} = &self->net.{member};"),
            false => writeln!(out, "    net->{member} = NULL;"),
        };
    }
    out.push_str("    net->lost = &self->net.lost;\n    net->conflicts = &self->net.conflicts;\n");
    let _ = writeln!(out, "    net->act = {tag}_act;\n    net->duration = {tag}_duration;\n    net->host = NULL;");
    let mut distance = 1;
    for (part, _, layout) in net.parts() {
        let inner = statements::instance(net, part);
        let statement = net.net.parts[part].statement.0;
        let _ = writeln!(out, "    {}_net(&{inner}, net + {distance});", layout.tag);
        let _ = writeln!(out, "    net[{distance}].outer = net;\n    net[{distance}].inputs = {statement};");
        distance += layout.net.as_ref().map_or(0, |net| net.nets);
    }
    out.push_str("}\n\n");
}

/// Writes a scan of an instance whose inputs are there.
pub(super) fn scan(out: &mut String, net: &NetBody<'_, '_, '_>) {
    let (tag, nets) = (net.tag(), net.layout.nets);
    let period = if net.layout.timed { "self->net.period" } else { "0" };
    let _ = writeln!(out, "    struct pcl2_net nets[{nets}];\n    {tag}_net(self, nets);");
    let _ = writeln!(out, "    pcl2_net_scan(nets, {nets}, &self->net.now, {period});");
}
