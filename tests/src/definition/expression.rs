//! Values and expressions.

/// A value: 32 bits or a double.
#[derive(Clone, Copy, Debug)]
pub enum Value {
    /// An int, also a truth value.
    Int(i32),
    /// A real.
    Real(f64),
}

/// An expression. Of what is not there, such as the attribute of an empty box, there is no value.
#[derive(Clone, Debug)]
pub enum Expression {
    /// A number in the text.
    Number(Value),
    /// An input, an element `z[2]`, a parameter, an output or a local.
    Word(String),
    /// The number of tokens of a box, `s` or `part.s`.
    Tokens(String),
    /// An attribute of a box's token.
    Attribute(String, String),
    /// `cause` of a PROCESS box.
    Cause(String),
    /// `NOT a`.
    Not(Box<Expression>),
    /// `-a`.
    Minus(Box<Expression>),
    /// Two operands.
    Two(Operator, Box<Expression>, Box<Expression>),
}

/// Operators between two operands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operator {
    /// `*`
    Times,
    /// `/`
    Over,
    /// `+`
    Plus,
    /// `-`
    Less,
    /// `<`
    Below,
    /// `<=`
    AtMost,
    /// `>`
    Above,
    /// `>=`
    AtLeast,
    /// `==`
    Equal,
    /// `<>`
    Unequal,
    /// `AND`
    And,
    /// `OR`
    Or,
}

impl Value {
    /// As a real.
    pub fn real(self) -> f64 {
        match self {
            Value::Int(int) => f64::from(int),
            Value::Real(real) => real,
        }
    }

    /// As an int.
    ///
    /// # Panics
    /// When it is a real: no real goes where an int is wanted.
    pub fn int(self) -> i32 {
        match self {
            Value::Int(int) => int,
            Value::Real(real) => panic!("expected an int, found {real}"),
        }
    }

    /// Whether it is a real that is no finite number.
    pub fn is_bad(self) -> bool {
        !self.real().is_finite()
    }

    /// Whether two are the same, bit for bit; one bad value is as good as another.
    pub fn same(self, other: Value) -> bool {
        let (a, b) = (self.real(), other.real());
        a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan())
    }

    /// In the type of another.
    pub fn like(self, other: Value) -> Value {
        match other {
            Value::Int(_) => Value::Int(self.int()),
            Value::Real(_) => Value::Real(self.real()),
        }
    }

    /// 0 in this type.
    pub fn zero(self) -> Value {
        match self {
            Value::Int(_) => Value::Int(0),
            Value::Real(_) => Value::Real(0.),
        }
    }
}

/// A value, and whether anything bad went into it.
#[derive(Clone, Copy, Debug)]
pub struct Found {
    /// The value.
    pub value: Value,
    /// Whether an operand or a result on the way is bad, or is not there.
    pub bad: bool,
}

impl From<Value> for Found {
    fn from(value: Value) -> Found {
        Found { value, bad: value.is_bad() }
    }
}

impl Expression {
    /// Its value, with operands from the function that finds them.
    pub fn value(&self, find: &dyn Fn(&Expression) -> Found) -> Found {
        match self {
            Expression::Number(value) => Found::from(*value),
            Expression::Word(_) | Expression::Tokens(_) | Expression::Attribute(..) | Expression::Cause(_) => {
                find(self)
            }
            Expression::Not(a) => {
                let a = a.value(find);
                Found { value: truth(a.value.int() == 0), bad: a.bad }
            }
            Expression::Minus(a) => {
                let a = a.value(find);
                let value = match a.value {
                    Value::Int(int) => Value::Int(int.saturating_neg()),
                    Value::Real(real) => Value::Real(-real),
                };
                Found { value, bad: a.bad }
            }
            Expression::Two(operator, a, b) => {
                let (a, b) = (a.value(find), b.value(find));
                let value = operator.apply(a.value, b.value);
                Found { value, bad: a.bad || b.bad || value.is_bad() }
            }
        }
    }

    /// Whether a word is an operand.
    pub fn reads(&self, word: &str) -> bool {
        match self {
            Expression::Word(name) => name == word,
            Expression::Number(_) | Expression::Tokens(_) | Expression::Attribute(..) | Expression::Cause(_) => false,
            Expression::Not(a) | Expression::Minus(a) => a.reads(word),
            Expression::Two(_, a, b) => a.reads(word) || b.reads(word),
        }
    }

    /// Whether attributes of a box are operands.
    pub fn asks(&self, place: &str) -> bool {
        match self {
            Expression::Attribute(name, _) => name == place,
            Expression::Number(_) | Expression::Word(_) | Expression::Tokens(_) | Expression::Cause(_) => false,
            Expression::Not(a) | Expression::Minus(a) => a.asks(place),
            Expression::Two(_, a, b) => a.asks(place) || b.asks(place),
        }
    }
}

fn truth(holds: bool) -> Value {
    Value::Int(i32::from(holds))
}

impl Operator {
    fn apply(self, a: Value, b: Value) -> Value {
        match self {
            Operator::And => truth(a.int() != 0 && b.int() != 0),
            Operator::Or => truth(a.int() != 0 || b.int() != 0),
            Operator::Below => truth(a.real() < b.real()),
            Operator::AtMost => truth(a.real() <= b.real()),
            Operator::Above => truth(a.real() > b.real()),
            Operator::AtLeast => truth(a.real() >= b.real()),
            // A comparison of doubles is one of the ints that became them.
            Operator::Equal => truth(a.real() == b.real()),
            Operator::Unequal => truth(!a.real().is_nan() && !b.real().is_nan() && a.real() != b.real()),
            Operator::Times | Operator::Over | Operator::Plus | Operator::Less => match (a, b) {
                (Value::Int(a), Value::Int(b)) => Value::Int(self.ints(a, b)),
                (Value::Real(_), _) | (_, Value::Real(_)) => Value::Real(self.reals(a.real(), b.real())),
            },
        }
    }

    fn ints(self, a: i32, b: i32) -> i32 {
        match self {
            Operator::Times => a.saturating_mul(b),
            Operator::Plus => a.saturating_add(b),
            Operator::Less => a.saturating_sub(b),
            Operator::Over if b == 0 => 0,
            Operator::Over => a.saturating_div(b),
            other => panic!("{other:?} does not compute"),
        }
    }

    fn reals(self, a: f64, b: f64) -> f64 {
        match self {
            Operator::Times => a * b,
            Operator::Plus => a + b,
            Operator::Less => a - b,
            Operator::Over if b.abs() < 1e-12 => f64::NAN,
            Operator::Over => a / b,
            other => panic!("{other:?} does not compute"),
        }
    }
}
