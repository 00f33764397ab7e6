//! Interned names.

use rustc_hash::FxHasher;
use std::hash::Hasher;

/// An interned name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Symbol(pub u32);

/// The table of names of one run: one text with all names, and an open hash table of their numbers.
#[derive(Clone, Debug, Default)]
pub struct Symbols {
    texts: String,
    ends: Vec<u32>,
    /// A power of two of slots, at most half of them taken.
    slots: Vec<u32>,
}

const FREE: u32 = u32::MAX;

impl Symbols {
    /// The symbol of a text.
    pub fn intern(&mut self, text: &str) -> Symbol {
        if self.slots.len() <= self.ends.len() * 2 {
            self.grow();
        }
        let slot = self.slot(text);
        if self.slots[slot] == FREE {
            self.slots[slot] = self.ends.len() as u32;
            self.texts.push_str(text);
            self.ends.push(self.texts.len() as u32);
        }
        Symbol(self.slots[slot])
    }

    /// The symbol of a text that was met before.
    pub fn find(&self, text: &str) -> Option<Symbol> {
        let symbol = *self.slots.get(self.slot(text))?;
        (symbol != FREE).then_some(Symbol(symbol))
    }

    /// The text of a symbol.
    pub fn text(&self, symbol: Symbol) -> &str {
        let index = symbol.0 as usize;
        let start = if index == 0 { 0 } else { self.ends[index - 1] };
        &self.texts[start as usize..self.ends[index] as usize]
    }

    /// Where a text is, or where it would go.
    fn slot(&self, text: &str) -> usize {
        let mask = self.slots.len().wrapping_sub(1);
        let mut slot = hash(text) & mask;
        while let Some(symbol) = self.slots.get(slot).filter(|symbol| **symbol != FREE) {
            if self.text(Symbol(*symbol)) == text {
                break;
            }
            slot = (slot + 1) & mask;
        }
        slot
    }

    fn grow(&mut self) {
        let size = (self.slots.len() * 2).max(1024);
        self.slots.clear();
        self.slots.resize(size, FREE);
        for symbol in 0..self.ends.len() as u32 {
            let mut slot = hash(self.text(Symbol(symbol))) & (size - 1);
            while self.slots[slot] != FREE {
                slot = (slot + 1) & (size - 1);
            }
            self.slots[slot] = symbol;
        }
    }
}

fn hash(text: &str) -> usize {
    let mut hasher = FxHasher::default();
    hasher.write(text.as_bytes());
    hasher.finish() as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_texts_are_one_symbol() {
        let mut symbols = Symbols::default();
        assert_eq!(symbols.find("y0"), None);
        let all: Vec<Symbol> = (0..5000).map(|i| symbols.intern(&format!("y{i}"))).collect();
        for (i, symbol) in all.iter().enumerate() {
            let text = format!("y{i}");
            assert_eq!((symbols.intern(&text), symbols.find(&text)), (*symbol, Some(*symbol)));
            assert_eq!(symbols.text(*symbol), text);
        }
        assert_eq!(symbols.find("y5000"), None);
        assert_ne!(symbols.intern(""), all[0]);
    }
}
