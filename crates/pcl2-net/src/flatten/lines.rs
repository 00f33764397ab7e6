//! Boxes and ACTIVE lines of the flat net.

use super::Flattener;
use super::words::shown;
use pcl2_lang::net::{BoxId, Kind, NetBox, Order, StatementId};
use std::fmt::Write;

impl Flattener<'_> {
    /// The boxes of a scope.
    pub(super) fn boxes(&mut self, scope: usize) -> Result<(), String> {
        for i in 0..self.scopes[scope].net.boxes.len() {
            let text = self.place(scope, BoxId(i as u32))?;
            self.text.push_str(&text);
        }
        Ok(())
    }

    fn place(&self, scope: usize, id: BoxId) -> Result<String, String> {
        let net = self.scopes[scope].net;
        let place = net.place(id);
        let name = self.names.place(scope, id);
        let mut text = match &place.kind {
            Kind::State if scope == 0 && net.entry == Some(id) => format!("ENTRY {name}"),
            Kind::State if scope == 0 && net.exit == Some(id) => format!("EXIT {name}"),
            Kind::State | Kind::Macro(_) => format!("STATE {name}"),
            Kind::Capacity => format!("CAPACITY {name}"),
            Kind::Time(time) => format!("TIME {name} {}", self.condition(scope, *time)?),
            Kind::Count => format!("COUNT {name} {}", place.capacity.unwrap_or(1)),
            Kind::Action(_) => format!("OPERATION {name}"),
            Kind::Process(_) => format!("PROCESS {name}"),
            Kind::Generation(_) => format!("GENERATE {name}"),
        };
        self.clauses(scope, id, &mut text);
        match &place.kind {
            Kind::Action(statements) => self.actions(scope, statements, "DO", &mut text)?,
            Kind::Process(process) => {
                if let Some(until) = process.until {
                    let _ = write!(text, " UNTIL {}", self.condition(scope, until)?);
                }
                if let Some(within) = process.within {
                    let _ = write!(text, " WITHIN {}", self.condition(scope, within)?);
                }
                self.actions(scope, &process.enter, "DO", &mut text)?;
                self.actions(scope, &process.after, "AFTER", &mut text)?;
            }
            Kind::Generation(generation) => {
                let _ = write!(text, " WHEN {}", self.condition(scope, generation.when)?);
                self.actions(scope, &generation.enter, "DO", &mut text)?;
            }
            Kind::State | Kind::Capacity | Kind::Time(_) | Kind::Count | Kind::Macro(_) => {}
        }
        if !text.ends_with('\n') {
            text.push('\n');
        }
        Ok(text)
    }

    /// Statements on lines of their own.
    pub(super) fn actions(
        &self,
        scope: usize,
        statements: &[StatementId],
        word: &str,
        text: &mut String,
    ) -> Result<(), String> {
        for id in statements {
            if !text.ends_with('\n') {
                text.push('\n');
            }
            text.push_str(&self.action(scope, *id, word)?);
        }
        Ok(())
    }

    fn clauses(&self, scope: usize, id: BoxId, text: &mut String) {
        let net = self.scopes[scope].net;
        let place = net.place(id);
        let is_macro = matches!(place.kind, Kind::Macro(_));
        if let Some(class) = place.class.filter(|_| !is_macro) {
            let _ = write!(text, " OF {}", self.names.classes[scope][class.0 as usize]);
        }
        if let (Kind::Capacity | Kind::Generation(_), Some(size)) = (&place.kind, place.capacity) {
            let _ = write!(text, " SIZE {size}");
        }
        let attribute =
            |index: &u32| net.attributes(place).get(*index as usize).map_or("", |known| known.name.as_str());
        let _ = match &place.order {
            Order::Fifo => Ok(()),
            Order::Lifo => write!(text, " ORDER lifo"),
            Order::Least(index) => write!(text, " ORDER least {}", attribute(index)),
            Order::Most(index) => write!(text, " ORDER most {}", attribute(index)),
        };
        if place.initial > 0 {
            text.push_str(&self.marking(scope, place));
        }
        let driven = self.driven(scope, id);
        if !driven.is_empty() {
            let _ = write!(text, " DRIVES {}", driven.join(", "));
        }
    }

    fn marking(&self, scope: usize, place: &NetBox) -> String {
        let attributes = self.scopes[scope].net.attributes(place);
        match (place.initial, attributes.is_empty()) {
            (1, false) => {
                let preset = attributes.iter().zip(&place.presets);
                let preset = preset.map(|(attribute, value)| format!("{} = {}", attribute.name, shown(value)));
                format!(" MARKED ( {} )", preset.collect::<Vec<_>>().join(", "))
            }
            (1, true) => " MARKED".to_owned(),
            (tokens, _) => format!(" MARKED {tokens}"),
        }
    }

    /// ACTIVE lines.
    pub(super) fn actives(&mut self) {
        for scope in 0..self.scopes.len() {
            for active in &self.scopes[scope].net.actives {
                let word = |id: pcl2_lang::net::WordId| self.words[scope][id.0 as usize].name.as_str();
                let time = active.time.map(|time| format!(", {}", word(time))).unwrap_or_default();
                let boxes: Vec<&str> = active.boxes.iter().map(|id| self.names.place(scope, *id)).collect();
                let line = format!("ACTIVE {}{time} OF {}\n", word(active.step), boxes.join(", "));
                self.text.push_str(&line);
            }
        }
    }
}
