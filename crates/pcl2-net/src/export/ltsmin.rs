//! A net as C behind LTSmin's interface to models, PINS: a row for each place that a transition touches.

use crate::pt::{Arc, PtNet, Transition};
use std::collections::BTreeMap;
use std::fmt::Write;

/// The C file of a net. Capacities, read arcs and inhibitors are conditions of a row.
pub fn ltsmin(net: &PtNet) -> Result<String, String> {
    if net.places.is_empty() || net.transitions.is_empty() {
        return Err("expected places and transitions, found none".to_owned());
    }
    let mut rows = Vec::new();
    let mut starts = vec![0];
    for transition in &net.transitions {
        rows.extend(rows_of(net, transition)?);
        starts.push(rows.len());
    }
    let initial = net.places.iter().map(|place| tokens(&place.name, place.initial));
    let initial = initial.collect::<Result<Vec<i32>, _>>()?;
    let mut text = String::from(HEAD);
    let _ = writeln!(text, "\nchar pins_plugin_name[] = {};\n", quoted(&net.name));
    let _ = writeln!(text, "#define PLACES {}\n#define TRANSITIONS {}\n", net.places.len(), net.transitions.len());
    strings(&mut text, "place_names[PLACES]", net.places.iter().map(|place| place.name.as_str()));
    strings(&mut text, "transition_names[TRANSITIONS]", net.transitions.iter().map(|row| row.name.as_str()));
    let _ = writeln!(text, "static int initial[PLACES] = {{\n{}}};\n", list(&initial));
    text.push_str(ROW);
    for row in &rows {
        let _ = writeln!(text, "    {{{}, {}, {}, {}}},", row.place, row.least, row.most, row.change);
    }
    // C has no empty array.
    text.push_str("    {0, 0, 0, 0},\n};\n\n");
    let _ = writeln!(text, "/* Where the rows of each transition begin. */");
    let _ = writeln!(text, "static const int starts[TRANSITIONS + 1] = {{\n{}}};\n", list(&starts));
    text.push_str(BODY);
    Ok(text)
}

/// What a transition asks of a place, and what it changes there.
struct Row {
    place: u32,
    least: i32,
    most: i32,
    change: i32,
}

#[derive(Default)]
struct Touched {
    least: u64,
    below: Option<u64>,
    takes: u64,
    puts: u64,
}

fn rows_of(net: &PtNet, transition: &Transition) -> Result<Vec<Row>, String> {
    let mut touched: BTreeMap<u32, Touched> = BTreeMap::new();
    let mut each = |arcs: &[Arc], note: &dyn Fn(&mut Touched, u64)| {
        arcs.iter().for_each(|arc| note(touched.entry(arc.place.0).or_default(), arc.weight));
    };
    each(&transition.takes, &|touched, weight| {
        (touched.takes, touched.least) = (weight, touched.least.max(weight));
    });
    each(&transition.reads, &|touched, weight| touched.least = touched.least.max(weight));
    each(&transition.puts, &|touched, weight| touched.puts = weight);
    each(&transition.inhibits, &|touched, weight| touched.below = Some(weight));
    touched.into_iter().map(|(place, touched)| row(net, transition, place, &touched)).collect()
}

fn row(net: &PtNet, transition: &Transition, place: u32, touched: &Touched) -> Result<Row, String> {
    let name = &transition.name;
    let capacity = net.places[place as usize].capacity;
    let grows = i64::from(tokens(name, touched.puts)?) - i64::from(tokens(name, touched.takes)?);
    // What needs no room may fire in a place that holds more than it can.
    let room = capacity
        .filter(|_| grows > 0)
        .map_or(i64::from(i32::MAX), |capacity| i64::try_from(capacity).unwrap_or(i64::MAX).min(i64::from(i32::MAX)));
    let below = touched.below.map_or(i64::MAX, |below| i64::try_from(below).unwrap_or(i64::MAX) - 1);
    let most = below.min(room - grows.max(0)).clamp(-1, i64::from(i32::MAX)) as i32;
    Ok(Row { place, least: tokens(name, touched.least)?, most, change: grows as i32 })
}

fn tokens(name: &str, count: u64) -> Result<i32, String> {
    i32::try_from(count).map_err(|_| format!("`{name}`: expected fewer than 2^31 tokens, found {count}"))
}

fn strings<'n>(text: &mut String, declared: &str, names: impl Iterator<Item = &'n str>) {
    let _ = writeln!(text, "static const char *const {declared} = {{");
    for name in names {
        let _ = writeln!(text, "    {},", quoted(name));
    }
    text.push_str("};\n\n");
}

/// Numbers in lines of ten.
fn list<T: ToString>(numbers: &[T]) -> String {
    let line = |numbers: &[T]| format!("    {},\n", numbers.iter().map(T::to_string).collect::<Vec<_>>().join(", "));
    numbers.chunks(10).map(line).collect()
}

fn quoted(text: &str) -> String {
    let mut quoted = String::from("\"");
    for byte in text.bytes() {
        let _ = match byte {
            b'"' | b'\\' => write!(quoted, "\\{}", char::from(byte)),
            // Three question marks in a row could be another character to old compilers.
            b' '..=b'~' if byte != b'?' => write!(quoted, "{}", char::from(byte)),
            _ => write!(quoted, "\\{byte:03o}"),
        };
    }
    quoted.push('"');
    quoted
}

const HEAD: &str =
    "/* A place/transition net behind LTSmin's PINS interface. Build a plugin of it, and hand that to a tool:
 *
 *     cc -shared -fPIC -o net.so net.c
 *     pins2lts-mc net.so
 *
 * A state holds the tokens of each place; a transition of the net is a group. */
#include <string.h>

#include <ltsmin/pins.h>
#include <ltsmin/pins-util.h>
#include <ltsmin/dlopen-api.h>
";

const ROW: &str =
    "/* A transition fires when each of its places has from `least` to `most` tokens; then they change. */
struct row {
    int place;
    int least;
    int most;
    int change;
};

static const struct row rows[] = {
";

const BODY: &str = "static int labels[TRANSITIONS];

static int next_state(model_t model, int group, int *state, TransitionCB callback, void *context)
{
    int after[PLACES];
    int i;
    (void)model;
    memcpy(after, state, sizeof after);
    for (i = starts[group]; i < starts[group + 1]; i++) {
        const struct row *row = &rows[i];
        if (state[row->place] < row->least || state[row->place] > row->most) {
            return 0;
        }
        after[row->place] += row->change;
    }
    transition_info_t info = GB_TI(&labels[group], group);
    callback(context, &info, after, NULL);
    return 1;
}

static void set_type(model_t model)
{
    int is_new, i;
    lts_type_t type = lts_type_create();
    int tokens = lts_type_put_type(type, \"tokens\", LTStypeDirect, &is_new);
    int action = lts_type_put_type(type, \"action\", LTStypeEnum, &is_new);
    lts_type_set_state_length(type, PLACES);
    for (i = 0; i < PLACES; i++) {
        lts_type_set_state_name(type, i, place_names[i]);
        lts_type_set_state_typeno(type, i, tokens);
    }
    lts_type_set_edge_label_count(type, 1);
    lts_type_set_edge_label_name(type, 0, \"action\");
    lts_type_set_edge_label_typeno(type, 0, action);
    lts_type_validate(type);
    GBsetLTStype(model, type);
    for (i = 0; i < TRANSITIONS; i++) {
        labels[i] = pins_chunk_put(model, action, chunk_str((char *)transition_names[i]));
    }
}

static void set_matrices(model_t model)
{
    static matrix_t touched, written;
    int group, i;
    dm_create(&touched, TRANSITIONS, PLACES);
    dm_create(&written, TRANSITIONS, PLACES);
    for (group = 0; group < TRANSITIONS; group++) {
        for (i = starts[group]; i < starts[group + 1]; i++) {
            dm_set(&touched, group, rows[i].place);
            if (rows[i].change != 0) {
                dm_set(&written, group, rows[i].place);
            }
        }
    }
    GBsetDMInfo(model, &touched);
    GBsetDMInfoRead(model, &touched);
    GBsetDMInfoMayWrite(model, &written);
    GBsetDMInfoMustWrite(model, &written);
}

void pins_model_init(model_t model)
{
    set_type(model);
    set_matrices(model);
    GBsetInitialState(model, initial);
    GBsetNextStateLong(model, next_state);
}
";
