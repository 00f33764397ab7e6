//! The table of diagnostics: one row each. Its page is `docs/errors/CODE.md`.

use crate::diagnostic::Severity;

/// A row of the table.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Code {
    name: &'static str,
    warning: bool,
}

impl Code {
    /// `P0203`
    pub fn name(self) -> &'static str {
        self.name
    }

    /// Error or warning.
    pub fn severity(self) -> Severity {
        if self.warning { Severity::Warning } else { Severity::Error }
    }
}

const fn error(name: &'static str) -> Code {
    Code { name, warning: false }
}

const fn warning(name: &'static str) -> Code {
    Code { name, warning: true }
}

// P00xx: text.

/// A character that has no meaning here.
pub const BAD_CHARACTER: Code = error("P0001");
/// Something else was expected here.
pub const UNEXPECTED: Code = error("P0002");
/// A parenthesis is never closed.
pub const UNCLOSED: Code = error("P0003");
/// A number that does not fit its type.
pub const NUMBER_RANGE: Code = error("P0004");
/// A dot that touches a real: probably a slip of the pen.
pub const STRAY_DOT: Code = warning("P0005");
/// The file has no END: it may be cut short.
pub const MISSING_END: Code = error("P0006");
/// Sections are missing, repeated or in the wrong order.
pub const SECTION: Code = error("P0007");
/// A file cannot be read, or is no source.
pub const UNREADABLE: Code = error("P0008");
/// A string is never closed.
pub const UNCLOSED_STRING: Code = error("P0009");
/// An expression that nests too deep.
pub const TOO_DEEP: Code = error("P0010");
/// A comment behind an expression that begins as another language's "not equal".
pub const NOT_EQUAL: Code = error("P0011");

// P01xx: names and numbers.

/// No function code has this name.
pub const UNKNOWN_CODE: Code = error("P0101");
/// No block writes this variable.
pub const UNKNOWN_VARIABLE: Code = error("P0102");
/// Two blocks have the same number, or their ports overlap.
pub const NUMBER_TAKEN: Code = error("P0103");
/// No block or port has this number.
pub const UNKNOWN_NUMBER: Code = error("P0104");
/// A number that names a named block where a constant may have been meant.
pub const NUMBER_OF_NAMED: Code = warning("P0105");
/// A name is too long, or reserved.
pub const BAD_NAME: Code = error("P0106");
/// The block has no output, port or parameter of this name.
pub const UNKNOWN_MEMBER: Code = error("P0107");
/// A user's block hides one of the catalogue.
pub const HIDDEN_CODE: Code = warning("P0108");
/// One name is given twice in a call.
pub const NAMED_TWICE: Code = error("P0109");
/// A block has more or other outputs than its code.
pub const OUTPUT_COUNT: Code = error("P0110");
/// A function code that is no function in an expression, or a call of it without its `:`.
pub const NO_FUNCTION: Code = error("P0111");

// P02xx: types, sizes, values.

/// Too few or too many inputs.
pub const INPUT_COUNT: Code = error("P0201");
/// Too few or too many parameters.
pub const PARAM_COUNT: Code = error("P0202");
/// Types or sizes differ.
pub const TYPE_DIFFERS: Code = error("P0203");
/// An index that the vector or matrix does not have.
pub const INDEX_RANGE: Code = error("P0204");
/// A real literal in a port.
pub const REAL_IN_PORT: Code = error("P0205");
/// A constant is needed here.
pub const CONSTANT_NEEDED: Code = error("P0206");
/// A value out of its declared range.
pub const OUT_OF_RANGE: Code = error("P0207");
/// A variable is too large, or the program is.
pub const TOO_LARGE: Code = error("P0208");
/// A parameter file cannot be used.
pub const PARAM_FILE: Code = error("P0209");
/// A value of the wrong kind for this place.
pub const VALUE_KIND: Code = error("P0210");
/// The kernel refuses the parameters.
pub const REFUSED: Code = error("P0211");
/// A size cannot be known.
pub const UNKNOWN_SIZE: Code = error("P0212");
/// A block that is legal in PLANT only, or an INITIALIZE block that may not be there.
pub const WRONG_SECTION: Code = error("P0213");
/// Nothing tells whether an expression is an int or a real.
pub const UNKNOWN_TYPE: Code = error("P0214");

// P03xx: order.

/// A delay of one scan that another number would avoid.
pub const AVOIDABLE_DELAY: Code = warning("P0301");
/// A second whole writer of a variable in one section.
pub const SECOND_WRITER: Code = warning("P0302");
/// A block that `--plant` names does not exist or cannot move.
pub const PLANT_LIST: Code = error("P0303");
/// A variable that PLANT and CONTROL both write.
pub const BOTH_SIDES: Code = error("P0304");
/// A block drives another that hands back what it follows, and does not listen.
pub const MISSING_RETURN: Code = warning("P0305");
/// A truth value made of a real reaches an output and does not say what it is when the real is bad.
pub const ON_BAD: Code = warning("P0306");

// P04xx: nets.

/// A box, gate, part, output or attribute that the net does not have.
pub const NET_NAME: Code = error("P0401");
/// Two things of a net have one name.
pub const NET_NAME_TAKEN: Code = error("P0402");
/// A token comes from nowhere or goes nowhere.
pub const ROUTE: Code = error("P0403");
/// More tokens than a box can hold.
pub const CAPACITY: Code = error("P0404");
/// Tokens of another class.
pub const TOKEN_CLASS: Code = error("P0405");
/// A part that cannot stand there.
pub const PART: Code = error("P0406");
/// An output that is driven and written, or neither.
pub const DRIVE: Code = error("P0407");
/// A line or clause of a net that is missing, repeated or in the wrong place.
pub const NET_LINE: Code = error("P0408");
/// A condition that is no truth value.
pub const CONDITION: Code = error("P0409");
/// A statement writes to a token that is not there yet.
pub const LOST_WRITE: Code = warning("P0410");

// P05xx: declarations, configuration and target.

/// A declaration file does not follow the notation.
pub const BAD_DECLARATION: Code = error("P0501");
/// A period is needed, or does not fit.
pub const PERIOD: Code = error("P0502");
/// `pcl2.toml` has a mistake.
pub const CONFIGURATION: Code = error("P0503");
/// The C of a user's block is missing.
pub const MISSING_KERNEL: Code = error("P0504");
/// The compiler contradicts itself.
pub const DEFECT: Code = error("P0599");
