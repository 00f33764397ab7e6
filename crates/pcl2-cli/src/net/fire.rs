//! `pcl2 net fire`

use super::{NetPath, load, refuse};
use crate::console;
use crate::outcome::Outcome;
use clap::Args;
use pcl2_net::pt::PtNet;
use pcl2_net::structure::fire::{OnBlocked, Rule, Scan, by_names, fire as fired, initial};
use pcl2_net::structure::matrix::WIDEST;
use pcl2_net::structure::names::Names;
use std::fmt::Write;

/// `pcl2 net fire`
#[derive(Args, Debug)]
pub(crate) struct FireArgs {
    #[command(flatten)]
    net: NetPath,
    /// Names of transitions, one after the other; those in braces fire in one scan: `t0 {t1 t2}`
    #[arg(required = true, value_name = "SEQUENCE")]
    sequence: Vec<String>,
    /// Print CSV: a column for each place
    #[arg(long)]
    csv: bool,
}

/// Fires transitions from the first marking on, after the state equation.
pub(crate) fn fire(args: &FireArgs) -> Outcome {
    let net = match load(&args.net.path, &args.net.blocks) {
        Ok(net) => net,
        Err(outcome) => return outcome,
    };
    match run(&net, args) {
        Ok(text) => console::answer(&text),
        Err(why) => refuse(&args.net.path, &why),
    }
}

fn run(net: &PtNet, args: &FireArgs) -> Result<String, String> {
    let groups = groups(&args.sequence.join(" "))?;
    let names = Names::new(net);
    let scan = |group: &Vec<String>| by_names(&names, group.iter().map(String::as_str));
    let scans: Vec<Scan> = groups.iter().map(scan).collect::<Result<_, _>>()?;
    let run = fired(net, &initial(net), &scans, Rule::Step, OnBlocked::Refuse)?;
    if let Some(blocked) = run.blocked.first() {
        return Err(blocked.message(net));
    }
    Ok(if args.csv { csv(net, &run.markings) } else { text(net, &groups, &run.markings) })
}

/// The scans of a sequence.
fn groups(sequence: &str) -> Result<Vec<Vec<String>>, String> {
    let spaced = sequence.replace('{', " { ").replace('}', " } ").replace(',', " ");
    let mut groups = Vec::new();
    let mut open: Option<Vec<String>> = None;
    for word in spaced.split_whitespace() {
        open = match (word, open.take()) {
            ("{", None) => Some(Vec::new()),
            ("}", Some(group)) => {
                groups.push(group);
                None
            }
            ("{", Some(_)) => return Err("expected `}` before the next `{`, found none".to_owned()),
            ("}", None) => return Err("expected `{` before `}`, found none".to_owned()),
            (name, Some(mut group)) => {
                group.push(name.to_owned());
                Some(group)
            }
            (name, None) => {
                groups.push(vec![name.to_owned()]);
                None
            }
        };
    }
    if open.is_some() {
        return Err("expected `}` at the end of the sequence, found none".to_owned());
    }
    Ok(groups)
}

/// A line for each marking: what fired before it, and the places that are marked.
fn text(net: &PtNet, groups: &[Vec<String>], markings: &[Vec<i128>]) -> String {
    let fired: Vec<String> = groups.iter().map(|group| group.join(" ")).collect();
    let width = fired.iter().map(|names| names.chars().count()).max().unwrap_or(0).min(WIDEST);
    let scans = std::iter::once("").chain(fired.iter().map(String::as_str));
    let mut text = String::new();
    for (k, (names, marking)) in scans.zip(markings).enumerate() {
        let marked = net.places.iter().zip(marking).filter(|(_, tokens)| **tokens != 0);
        let shown = marked.map(|(place, tokens)| match tokens {
            1 => place.name.clone(),
            tokens => format!("{tokens}*{}", place.name),
        });
        let shown = shown.collect::<Vec<_>>().join(" ");
        let _ = writeln!(text, "{k:>3}  {names:width$}  {shown}");
    }
    text
}

fn csv(net: &PtNet, markings: &[Vec<i128>]) -> String {
    let mut writer = csv::Writer::from_writer(Vec::new());
    let _ = writer.write_record(std::iter::once("k").chain(net.places.iter().map(|place| place.name.as_str())));
    for (k, marking) in markings.iter().enumerate() {
        let _ = writer.write_record(std::iter::once(k.to_string()).chain(marking.iter().map(i128::to_string)));
    }
    String::from_utf8_lossy(&writer.into_inner().unwrap_or_default()).into_owned()
}
