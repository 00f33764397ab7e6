//! A program that runs the emitted C: a loop in C between a script and a stream of binary records.

const TEXT: &str = include_str!("runner.c");

/// Written before each record.
pub const ROW: u64 = 1;
/// Scan and point of a refused set follow.
pub const REFUSED: u64 = 2;
/// The health record and the parameters follow; nothing comes after.
pub const END: u64 = 3;

/// A point of the map and an element, counted from 0.
pub type Place = (u32, u32);

/// What the runner is to do. All words are 64 bits in the host's order.
#[derive(Clone, Debug, Default)]
pub struct Script {
    /// How many scans.
    pub scans: u64,
    /// What a row holds.
    pub columns: Vec<Place>,
    /// What the end holds.
    pub params: Vec<Place>,
    /// The scans after which a row is written, ascending; `None` for each.
    pub rows: Option<Vec<u64>>,
    /// Before a scan, a place gets the bits of a value; in order of the scan.
    pub events: Vec<(u64, Place, u64)>,
}

impl Script {
    /// The file that the runner reads.
    pub fn bytes(&self) -> Vec<u8> {
        let place = |(point, element): Place| u64::from(point) << 32 | u64::from(element);
        let rows: &[u64] = self.rows.as_deref().unwrap_or(&[]);
        let counts = [self.columns.len(), self.params.len()].map(|count| count as u64);
        let mut words = vec![self.scans, counts[0], counts[1], u64::from(self.rows.is_none())];
        words.extend([rows.len() as u64, self.events.len() as u64]);
        words.extend(self.columns.iter().chain(&self.params).map(|at| place(*at)));
        words.extend(rows);
        words.extend(self.events.iter().flat_map(|(scan, at, bits)| [*scan, place(*at), *bits]));
        let count = words.len() as u64;
        [count].into_iter().chain(words).flat_map(u64::to_ne_bytes).collect()
    }
}

/// The C file of the runner. It includes `NAME.c`; the other C files of the program are linked.
pub fn runner(name: &str) -> String {
    TEXT.replace("@NAME@", name)
}
