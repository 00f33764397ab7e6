//! `[io]` of the project file: physical points bound to the program's words.

use crate::config::{Binding as Line, Config};
use pcl2_lang::border::{Part, cut};
use pcl2_lang::codes;
use pcl2_lang::decl::Direction;
use pcl2_lang::diagnostic::Diagnostic;
use pcl2_lang::program::{Binding, Program, Role};
use pcl2_lang::suggest;
use pcl2_lang::types::{Real, Scalar};

/// Binds what `[io]` names.
pub(crate) fn bind(config: &Config, program: &mut Program, diagnostics: &mut Vec<Diagnostic>) {
    if config.io.is_empty() {
        return;
    }
    let words = words(program);
    for line in &config.io {
        let Some(word) = words.iter().find(|word| word.name == line.name) else {
            diagnostics.push(unknown(line, &words));
            continue;
        };
        if let Some(message) = misuse(line, word) {
            diagnostics.push(Diagnostic::new(codes::CONFIGURATION, line.span, message));
            continue;
        }
        let fail = line.fail.map(real);
        if let Some(image) = program.images.iter_mut().find(|image| image.name == line.name) {
            image.fail = fail;
        }
        let (gain, bias) = scaling(line.scale);
        let point = line.point.clone();
        program.bindings.push(Binding { name: line.name.clone(), point, gain, bias, hold: line.hold_bad, fail });
    }
}

/// What can be bound.
struct Word {
    name: String,
    to_plant: bool,
    scalar: Scalar,
    single: bool,
}

/// The named inputs and outputs of the controller, and the image words.
fn words(program: &Program) -> Vec<Word> {
    let controller = cut(program, Part::Control);
    let images = controller.images.iter().map(|image| Word {
        name: image.name.clone(),
        to_plant: image.direction == Direction::Out,
        scalar: image.scalar,
        single: true,
    });
    // Before the cut a net that is a program of its own has them already.
    let signals = program.main().signals.iter().chain(&controller.main().signals);
    let crossing = signals.filter(|signal| matches!(signal.role, Role::Input | Role::Output));
    let signals = crossing.map(|signal| Word {
        name: signal.name.clone(),
        to_plant: signal.role == Role::Output,
        scalar: signal.ty.scalar,
        single: signal.ty.is_scalar(),
    });
    images.chain(signals).collect()
}

fn unknown(line: &Line, words: &[Word]) -> Diagnostic {
    let message = format!("expected an input, an output or an address of the program, found `{}`", line.name);
    let known: Vec<&str> = words.iter().map(|word| word.name.as_str()).collect();
    let help = suggest::help(&line.name, known.iter().copied()).unwrap_or_else(|| match known.as_slice() {
        [] => "the program has none".to_owned(),
        names => format!("it has {}", names.join(", ")),
    });
    Diagnostic::new(codes::CONFIGURATION, line.span, message).help(help)
}

fn misuse(line: &Line, word: &Word) -> Option<String> {
    let name = &line.name;
    if line.point.is_empty() {
        Some(format!("expected the physical point of `{name}`, found none"))
    } else if !word.single {
        Some(format!("expected a number to bind, found `{name}`, which is a vector or matrix"))
    } else if word.to_plant && line.hold_bad {
        Some(format!("expected `bad` for an input, found it for the output `{name}`; use `fail`"))
    } else if !word.to_plant && line.fail.is_some() {
        Some(format!("expected `fail` for an output, found it for the input `{name}`; use `bad`"))
    } else if word.scalar == Scalar::Int && line.fail.is_some() {
        Some(format!("expected `fail` for a real, found it for the int `{name}`, which is never bad"))
    } else {
        None
    }
}

/// `raw = [a, b], range = [c, d]`: word = gain raw + bias.
fn scaling(scale: Option<[f64; 4]>) -> (Real, Real) {
    let Some([raw_low, raw_high, low, high]) = scale else {
        return (real(1.0), real(0.0));
    };
    let gain = (high - low) / (raw_high - raw_low);
    (real(gain), real(low - gain * raw_low))
}

fn real(value: f64) -> Real {
    Real { wide: value, narrow: value as f32 }
}
