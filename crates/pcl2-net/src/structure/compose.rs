//! A net's matrix from the matrices of its parts, by the composition law of Jeong and Yang: B is the sum over the modules
//! k of their copies divided by D_k, the number of copies.
//!
//! A part, such as the sub-net of a step, holds whole modules, and several parts may hold the same one. Copies that agree
//! add up to D_k times the module.

use crate::structure::matrix::Matrix;
use crate::structure::modules::{Groups, titles};
use rustc_hash::FxHashMap;
use std::collections::BTreeMap;

/// The matrix of a part of a net.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Piece {
    /// What messages call it.
    pub name: String,
    /// B, B- or B+.
    pub matrix: Matrix,
}

/// A net's matrix, put together.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Composition {
    /// Over all places and transitions, in the order in which they appear first.
    pub matrix: Matrix,
    /// The modules.
    pub modules: Vec<Duplication>,
}

/// A module and in how many parts it stands.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Duplication {
    /// The module's name, made of those of its places.
    pub module: String,
    /// D_k.
    pub copies: usize,
}

/// Composes the matrix. An error when two copies of a module differ, or when one is not whole: then the sum of the
/// copies is not D_k times the module.
pub fn compose(pieces: &[Piece]) -> Result<Composition, String> {
    let union = Union::new(pieces);
    let modules = Modules::new(&union);
    union.agree(&modules)?;
    let copies = union.copies(&modules)?;
    let label = pieces.first().map_or("", |piece| piece.matrix.label.as_str());
    let owned = |names: &[&str]| names.iter().map(|name| (*name).to_owned()).collect();
    let mut matrix = Matrix::zero(label, owned(&union.rows.names), owned(&union.columns.names));
    for entry in union.entries() {
        matrix.set(entry.row, entry.column, matrix.entry(entry.row, entry.column) + entry.value);
    }
    for row in 0..matrix.rows.len() {
        for (column, sum) in matrix.row(row).to_vec() {
            matrix.set(row, column as usize, sum / copies[modules.of_row[row]] as i128);
        }
    }
    let modules = modules.names.into_iter().zip(copies).map(|(module, copies)| Duplication { module, copies });
    Ok(Composition { matrix, modules: modules.collect() })
}

/// The names of all rows or of all columns.
#[derive(Default)]
struct Axis<'a> {
    names: Vec<&'a str>,
    numbers: FxHashMap<&'a str, usize>,
    /// Of each piece the numbers of its names.
    pieces: Vec<Vec<usize>>,
    /// Of each name the pieces that have it, and its place there.
    places: Vec<Vec<(usize, usize)>>,
}

impl<'a> Axis<'a> {
    fn take(&mut self, names: &'a [String]) {
        let piece = self.pieces.len();
        let mut own = Vec::with_capacity(names.len());
        for (at, name) in names.iter().enumerate() {
            let number = *self.numbers.entry(name).or_insert(self.names.len());
            if number == self.names.len() {
                self.names.push(name);
                self.places.push(Vec::new());
            }
            self.places[number].push((piece, at));
            own.push(number);
        }
        self.pieces.push(own);
    }

    /// Where a piece has a name.
    fn place(&self, number: usize, piece: usize) -> Option<usize> {
        let places = &self.places[number];
        places.binary_search_by_key(&piece, |place| place.0).ok().map(|at| places[at].1)
    }
}

/// An entry of a piece, in the numbering of the whole.
#[derive(Clone, Copy)]
struct Entry {
    piece: usize,
    row: usize,
    column: usize,
    value: i128,
}

struct Union<'a> {
    pieces: &'a [Piece],
    rows: Axis<'a>,
    columns: Axis<'a>,
}

impl<'a> Union<'a> {
    fn new(pieces: &'a [Piece]) -> Union<'a> {
        let (mut rows, mut columns) = (Axis::default(), Axis::default());
        for piece in pieces {
            rows.take(&piece.matrix.rows);
            columns.take(&piece.matrix.columns);
        }
        Union { pieces, rows, columns }
    }

    fn entries(&self) -> impl Iterator<Item = Entry> {
        self.pieces.iter().enumerate().flat_map(move |(piece, named)| {
            (0..named.matrix.rows.len()).flat_map(move |at| {
                named.matrix.row(at).iter().map(move |(column, value)| Entry {
                    piece,
                    row: self.rows.pieces[piece][at],
                    column: self.columns.pieces[piece][*column as usize],
                    value: *value,
                })
            })
        })
    }

    /// Where two pieces have the place and the transition of an entry, they have the same value.
    fn agree(&self, modules: &Modules) -> Result<(), String> {
        for entry in self.entries() {
            for (piece, row) in self.rows.places[entry.row].iter().filter(|(piece, _)| *piece != entry.piece) {
                let column = self.columns.place(entry.column, *piece);
                let found = column.map(|column| self.pieces[*piece].matrix.entry(*row, column));
                if let Some(found) = found.filter(|found| *found != entry.value) {
                    return Err(self.difference(modules, entry, *piece, found));
                }
            }
        }
        Ok(())
    }

    fn difference(&self, modules: &Modules, entry: Entry, other: usize, found: i128) -> String {
        let (module, value) = (&modules.names[modules.of_row[entry.row]], entry.value);
        let (place, transition) = (self.rows.names[entry.row], self.columns.names[entry.column]);
        let (first, second) = (&self.pieces[entry.piece].name, &self.pieces[other].name);
        format!(
            "module `{module}`, place `{place}`, transition `{transition}`: expected equal copies, found {value} in \
             `{first}` and {found} in `{second}`"
        )
    }

    /// D of each module: how many pieces have it. Each of them has all of it.
    fn copies(&self, modules: &Modules) -> Result<Vec<usize>, String> {
        let mut copies = vec![0; modules.names.len()];
        for (i, piece) in self.pieces.iter().enumerate() {
            let (rows, columns) = (&self.rows.pieces[i], &self.columns.pieces[i]);
            let of_rows = rows.iter().map(|row| modules.of_row[*row]);
            let mut sizes: BTreeMap<usize, usize> = BTreeMap::new();
            for module in of_rows.chain(columns.iter().map(|column| modules.of_column[*column])) {
                *sizes.entry(module).or_default() += 1;
            }
            for (module, size) in sizes {
                copies[module] += 1;
                if size < modules.sizes[module] {
                    return Err(self.gap(modules, module, i, &piece.name));
                }
            }
        }
        Ok(copies)
    }

    /// What a piece lacks of a module.
    fn gap(&self, modules: &Modules, module: usize, piece: usize, name: &str) -> String {
        let lacks = |axis: &Axis<'a>, of: &[usize]| {
            let lacking = |number: &usize| of[*number] == module && axis.place(*number, piece).is_none();
            let number = (0..axis.names.len()).find(lacking)?;
            let other = axis.places[number].first().map(|place| self.pieces[place.0].name.as_str())?;
            Some((axis.names[number].to_owned(), other.to_owned()))
        };
        let place = lacks(&self.rows, &modules.of_row).map(|found| ("place", found));
        let transition = || lacks(&self.columns, &modules.of_column).map(|found| ("transition", found));
        let (what, (lacking, other)) = place.or_else(transition).unwrap_or_default();
        format!(
            "module `{}`: expected whole copies, found none of the {what} `{lacking}` of `{other}` in `{name}`",
            modules.names[module]
        )
    }
}

/// The modules of all pieces together: rows and columns that entries connect.
struct Modules {
    names: Vec<String>,
    /// How many rows and columns.
    sizes: Vec<usize>,
    of_row: Vec<usize>,
    of_column: Vec<usize>,
}

impl Modules {
    fn new(union: &Union<'_>) -> Modules {
        let rows = union.rows.names.len();
        let mut groups = Groups::new(rows + union.columns.names.len());
        for entry in union.entries() {
            groups.join(entry.row, rows + entry.column);
        }
        let mut of_row = groups.numbers();
        let count = of_row.iter().max().map_or(0, |last| last + 1);
        let of_column = of_row.split_off(rows);
        let mut members: Vec<Vec<&str>> = vec![Vec::new(); count];
        let mut sizes = vec![0; count];
        for (row, module) in of_row.iter().enumerate() {
            members[*module].push(union.rows.names[row]);
            sizes[*module] += 1;
        }
        for (column, module) in of_column.iter().enumerate() {
            if sizes[*module] == 0 {
                members[*module].push(union.columns.names[column]);
            }
            sizes[*module] += 1;
        }
        Modules { names: titles(members), sizes, of_row, of_column }
    }
}
