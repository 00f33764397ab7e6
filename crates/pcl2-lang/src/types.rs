//! Types of signals and the values that stand in sources.

use std::fmt;

/// The largest number of elements in one variable.
pub const MAX_ELEMENTS: u64 = 1 << 24;

/// The number type of a signal's elements.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Scalar {
    /// A 32-bit integer; also a truth value.
    Int,
    /// `double`, or `float` with `--real f32`.
    Real,
}

/// The width of `real` in the generated C.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Width {
    /// C `float`.
    F32,
    /// C `double`.
    #[default]
    F64,
}

impl Width {
    /// Bytes of one real.
    pub fn bytes(self) -> usize {
        match self {
            Width::F32 => 4,
            Width::F64 => 8,
        }
    }
}

/// How many elements a signal has, and in what order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Shape {
    /// One element.
    Scalar,
    /// `n` elements.
    Vector(u32),
    /// `r` rows of `c` elements, row-major.
    Matrix(u32, u32),
}

/// The type of a signal: `int`, `real`, `ivec[n]`, `vec[n]`, `imat[r,c]`, `mat[r,c]`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Type {
    /// What one element is.
    pub scalar: Scalar,
    /// How the elements are arranged.
    pub shape: Shape,
}

impl Type {
    /// The scalar integer type.
    pub const INT: Type = Type { scalar: Scalar::Int, shape: Shape::Scalar };
    /// The scalar real type.
    pub const REAL: Type = Type { scalar: Scalar::Real, shape: Shape::Scalar };

    /// Number of elements; at most [`MAX_ELEMENTS`] in a verified program.
    pub fn elements(self) -> usize {
        match self.shape {
            Shape::Scalar => 1,
            Shape::Vector(n) => n as usize,
            Shape::Matrix(r, c) => (u64::from(r) * u64::from(c)) as usize,
        }
    }

    /// Whether the type is one int or one real.
    pub fn is_scalar(self) -> bool {
        self.shape == Shape::Scalar
    }

    /// Rows and columns, with a vector as one column: at a port `vec[n]` and `mat[n,1]` are the same.
    pub fn rows_columns(self) -> (u32, u32) {
        match self.shape {
            Shape::Scalar => (1, 1),
            Shape::Vector(n) => (n, 1),
            Shape::Matrix(r, c) => (r, c),
        }
    }
}

impl fmt::Display for Type {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let prefix = match self.scalar {
            Scalar::Int => "i",
            Scalar::Real => "",
        };
        match (self.shape, self.scalar) {
            (Shape::Scalar, Scalar::Int) => write!(f, "int"),
            (Shape::Scalar, Scalar::Real) => write!(f, "real"),
            (Shape::Vector(n), _) => write!(f, "{prefix}vec[{n}]"),
            (Shape::Matrix(r, c), _) => write!(f, "{prefix}mat[{r},{c}]"),
        }
    }
}

/// A real literal in both widths: each is converted once, from the decimal text.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Real {
    /// The nearest double.
    pub wide: f64,
    /// The nearest float.
    pub narrow: f32,
}

impl Real {
    /// Zero in both widths.
    pub const ZERO: Real = Real { wide: 0.0, narrow: 0.0 };

    /// The bad signal: not a number.
    pub const BAD: Real = Real { wide: f64::NAN, narrow: f32::NAN };

    /// An integer as a real.
    pub fn from_int(value: i32) -> Real {
        Real { wide: f64::from(value), narrow: value as f32 }
    }
}

/// The value of one parameter place, or of a port's default.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A scalar integer.
    Int(i32),
    /// A scalar real.
    Real(Real),
    /// The elements of an integer vector or matrix, row-major.
    Ints(Box<[i32]>),
    /// The elements of a real vector or matrix, row-major.
    Reals(Box<[Real]>),
    /// The value of a `text` parameter.
    Text(Box<str>),
}
