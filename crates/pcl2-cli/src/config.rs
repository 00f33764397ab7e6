//! `pcl2.toml`: what is decided about a project beside its sources.

use pcl2_emit::NetForm;
use pcl2_lang::codes;
use pcl2_lang::diagnostic::Diagnostic;
use pcl2_lang::source::{FileId, Sources, Span};
use pcl2_lang::suggest;
use pcl2_lang::types::Width;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// The content of `pcl2.toml`.
#[derive(Clone, Debug, Default)]
pub(crate) struct Config {
    /// `[controller] name`
    pub(crate) name: Option<String>,
    /// `[controller] source`
    pub(crate) source: Option<(String, Span)>,
    /// `[controller] period`, as a decimal of seconds.
    pub(crate) period: Option<(String, Span)>,
    /// `[controller] real`
    pub(crate) width: Option<Width>,
    /// `[controller] target`
    pub(crate) target: Option<String>,
    /// `[controller] blocks`
    pub(crate) blocks: Vec<(String, Span)>,
    /// `[sim] substeps`
    pub(crate) substeps: Option<u32>,
    /// `[build] tunable`
    pub(crate) tunable: pcl2_cfg::Tunable,
    /// `[build] net_form`
    pub(crate) net_form: Option<NetForm>,
    /// Where `tunable` stands.
    pub(crate) tunable_span: Option<Span>,
    /// `[io]`
    pub(crate) io: Vec<Binding>,
}

/// One line of `[io]`: a name of the program bound to a physical point.
#[derive(Clone, Debug)]
pub(crate) struct Binding {
    /// The named input or output, or the image word: `y1`, `ain(0,1,1)`.
    pub(crate) name: String,
    /// Where the name stands.
    pub(crate) span: Span,
    /// The physical point.
    pub(crate) point: String,
    /// Raw range and engineering range, for linear scaling.
    pub(crate) scale: Option<[f64; 4]>,
    /// A bad sample is held instead of handed on.
    pub(crate) hold_bad: bool,
    /// What an output takes instead of a bad value; without it, it holds.
    pub(crate) fail: Option<f64>,
}

const SECTIONS: [&str; 4] = ["controller", "io", "sim", "build"];
const RESERVED: [&str; 3] = ["signal", "scenario", "restart"];

/// Reads the file's text.
pub(crate) fn read(sources: &Sources, file: FileId, diagnostics: &mut Vec<Diagnostic>) -> Config {
    let text = &sources.file(file).text;
    let mut reader = Reader { file, diagnostics };
    let table = match DeTable::parse(text) {
        Ok(table) => table,
        Err(error) => {
            let span = error.span().unwrap_or(0..0);
            reader.complain(&span, format!("expected TOML, found a mistake: {}", error.message()), None);
            return Config::default();
        }
    };
    reader.config(table.get_ref())
}

struct Reader<'a> {
    file: FileId,
    diagnostics: &'a mut Vec<Diagnostic>,
}

type Key<'i> = Spanned<std::borrow::Cow<'i, str>>;

impl Reader<'_> {
    fn complain(&mut self, span: &std::ops::Range<usize>, message: String, help: Option<String>) {
        let report = Diagnostic::new(codes::CONFIGURATION, self.span(span), message);
        self.diagnostics.push(match help {
            Some(help) => report.help(help),
            None => report,
        });
    }

    fn span(&self, span: &std::ops::Range<usize>) -> Span {
        Span { file: self.file, start: span.start as u32, end: span.end as u32 }
    }

    fn config(&mut self, table: &DeTable<'_>) -> Config {
        let mut config = Config::default();
        for (key, value) in table.iter() {
            let name = key.get_ref().as_ref();
            if RESERVED.contains(&name) {
                let message = format!("expected a section that this version knows, found [{name}], which is reserved");
                self.complain(&key.span(), message, Some("its feature does not exist yet".to_owned()));
                continue;
            }
            let DeValue::Table(section) = value.get_ref() else {
                self.unknown(key, &SECTIONS, "a section");
                continue;
            };
            match name {
                "controller" => self.controller(section, &mut config),
                "sim" => self.sim(section, &mut config),
                "build" => self.build(section, &mut config),
                "io" => self.io(section, &mut config),
                _ => self.unknown(key, &SECTIONS, "a section"),
            }
        }
        config
    }

    fn unknown(&mut self, key: &Key<'_>, known: &[&str], what: &str) {
        let message = format!("expected {what} of {}, found `{}`", known.join(", "), key.get_ref());
        self.complain(&key.span(), message, suggest::help(key.get_ref(), known.iter().copied()));
    }

    fn controller(&mut self, section: &DeTable<'_>, config: &mut Config) {
        for (key, value) in section.iter() {
            match key.get_ref().as_ref() {
                "name" => config.name = self.text(value),
                "source" => config.source = self.text(value).map(|name| (name, self.span(&value.span()))),
                "period" => config.period = self.number(value).map(|number| (number, self.span(&value.span()))),
                "real" => config.width = self.width(value),
                "target" => config.target = self.text(value),
                "blocks" => config.blocks = self.places(value),
                _ => self.unknown(key, &["name", "source", "period", "real", "target", "blocks"], "a key"),
            }
        }
    }

    fn sim(&mut self, section: &DeTable<'_>, config: &mut Config) {
        for (key, value) in section.iter() {
            match key.get_ref().as_ref() {
                "substeps" => {
                    let number = self.number(value).and_then(|text| text.parse::<u32>().ok());
                    let valid = number.filter(|n| (1..=1000).contains(n));
                    if valid.is_none() {
                        self.complain(
                            &value.span(),
                            "expected substeps from 1 to 1000, found something else".to_owned(),
                            None,
                        );
                    }
                    config.substeps = valid;
                }
                _ => self.unknown(key, &["substeps"], "a key"),
            }
        }
    }

    fn build(&mut self, section: &DeTable<'_>, config: &mut Config) {
        for (key, value) in section.iter() {
            match key.get_ref().as_ref() {
                "tunable" => {
                    config.tunable_span = Some(self.span(&value.span()));
                    config.tunable = match value.get_ref() {
                        DeValue::String(text) if text == "all" => pcl2_cfg::Tunable::All,
                        DeValue::String(text) if text == "none" => pcl2_cfg::Tunable::None,
                        DeValue::Array(_) => pcl2_cfg::Tunable::Names(self.texts(value)),
                        _ => {
                            let message = "expected \"all\", \"none\" or a list of names, found something else";
                            self.complain(&value.span(), message.to_owned(), None);
                            pcl2_cfg::Tunable::All
                        }
                    }
                }
                "net_form" => config.net_form = self.net_form(value),
                _ => self.unknown(key, &["tunable", "net_form"], "a key"),
            }
        }
    }

    fn io(&mut self, section: &DeTable<'_>, config: &mut Config) {
        for (key, value) in section.iter() {
            let mut binding = Binding {
                name: key.get_ref().to_string(),
                span: self.span(&key.span()),
                point: String::new(),
                scale: None,
                hold_bad: false,
                fail: None,
            };
            match value.get_ref() {
                DeValue::String(point) => binding.point = point.to_string(),
                DeValue::Table(table) => self.binding(table, &mut binding),
                _ => self.complain(
                    &value.span(),
                    "expected a point's name or a table, found something else".to_owned(),
                    None,
                ),
            }
            config.io.push(binding);
        }
    }

    fn binding(&mut self, table: &DeTable<'_>, binding: &mut Binding) {
        let (mut raw, mut range) = (None, None);
        for (key, value) in table.iter() {
            match key.get_ref().as_ref() {
                "point" => binding.point = self.text(value).unwrap_or_default(),
                "raw" => raw = self.pair(value),
                "range" => range = self.pair(value),
                "bad" => {
                    let text = self.text(value).unwrap_or_default();
                    if !["pass", "hold"].contains(&text.as_str()) {
                        self.complain(&value.span(), format!("expected \"pass\" or \"hold\", found \"{text}\""), None);
                    }
                    binding.hold_bad = text == "hold";
                }
                "fail" => binding.fail = self.real(value),
                _ => self.unknown(key, &["point", "raw", "range", "bad", "fail"], "a key"),
            }
        }
        binding.scale = match (raw, range) {
            (Some([a, b]), Some([c, d])) => Some([a, b, c, d]),
            (None, None) => None,
            _ => {
                let span = binding.span.start as usize..binding.span.end as usize;
                self.complain(&span, "expected raw and range together, found one of them".to_owned(), None);
                None
            }
        };
    }

    fn pair(&mut self, value: &Spanned<DeValue<'_>>) -> Option<[f64; 2]> {
        if let DeValue::Array(list) = value.get_ref() {
            if let [low, high] = &list[..] {
                let pair = [self.real(low)?, self.real(high)?];
                if pair[0] == pair[1] {
                    self.complain(
                        &value.span(),
                        "expected two different ends of a range, found equal ones".to_owned(),
                        None,
                    );
                }
                return Some(pair);
            }
        }
        self.complain(&value.span(), "expected two numbers, found something else".to_owned(), None);
        None
    }

    fn real(&mut self, value: &Spanned<DeValue<'_>>) -> Option<f64> {
        let number = self.number(value)?.parse::<f64>().ok().filter(|number| number.is_finite());
        if number.is_none() {
            self.complain(&value.span(), "expected a finite number, found something else".to_owned(), None);
        }
        number
    }

    /// The decimal text of a number.
    fn number(&mut self, value: &Spanned<DeValue<'_>>) -> Option<String> {
        match value.get_ref() {
            DeValue::Float(number) => Some(number.as_str().replace('_', "")),
            DeValue::Integer(number) if number.radix() == 10 => Some(number.as_str().replace('_', "")),
            _ => {
                self.complain(&value.span(), "expected a decimal number, found something else".to_owned(), None);
                None
            }
        }
    }

    fn text(&mut self, value: &Spanned<DeValue<'_>>) -> Option<String> {
        if let DeValue::String(text) = value.get_ref() {
            return Some(text.to_string());
        }
        self.complain(&value.span(), "expected a string, found something else".to_owned(), None);
        None
    }

    fn texts(&mut self, value: &Spanned<DeValue<'_>>) -> Vec<String> {
        let DeValue::Array(list) = value.get_ref() else {
            self.complain(&value.span(), "expected a list of strings, found something else".to_owned(), None);
            return Vec::new();
        };
        list.iter().filter_map(|item| self.text(item)).collect()
    }

    /// Strings, each with its place.
    fn places(&mut self, value: &Spanned<DeValue<'_>>) -> Vec<(String, Span)> {
        let DeValue::Array(list) = value.get_ref() else {
            return self.texts(value).into_iter().map(|text| (text, self.span(&value.span()))).collect();
        };
        list.iter().filter_map(|item| Some((self.text(item)?, self.span(&item.span())))).collect()
    }

    fn net_form(&mut self, value: &Spanned<DeValue<'_>>) -> Option<NetForm> {
        match self.text(value)?.as_str() {
            "fast" => Some(NetForm::Fast),
            "table" => Some(NetForm::Table),
            other => {
                let message = format!("expected \"fast\" or \"table\", found \"{other}\"");
                self.complain(&value.span(), message, None);
                None
            }
        }
    }

    fn width(&mut self, value: &Spanned<DeValue<'_>>) -> Option<Width> {
        match self.text(value)?.as_str() {
            "f32" => Some(Width::F32),
            "f64" => Some(Width::F64),
            other => {
                self.complain(&value.span(), format!("expected \"f32\" or \"f64\", found \"{other}\""), None);
                None
            }
        }
    }
}
