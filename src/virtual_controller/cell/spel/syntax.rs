//! What a text of the subset says, before it is executed.

/// One statement.
#[derive(Debug, Clone, PartialEq)]
pub enum Statement {
    Print(Vec<Expression>),
    Where,
    /// `On`, `Off`, `MemOn`, `MemOff`.
    Bit {
        place: Place,
        bit: Expression,
        on: bool,
    },
    /// `Out`, `MemOut`.
    Byte {
        place: Place,
        port: Expression,
        value: Expression,
    },
    Motor {
        on: bool,
    },
    Power {
        high: bool,
    },
    Speed(Expression),
    SpeedFactor(Expression),
    Robot(Expression),
    Go(Point),
    Jump(Point),
    Home,
    Assign {
        variable: Variable,
        value: Expression,
    },
}

/// Where a bit is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    Input,
    Output,
    Memory,
}

/// How many bits are read at once.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Width {
    Bit,
    Byte,
    Word,
}

/// A value that is calculated when the statement is executed.
#[derive(Debug, Clone, PartialEq)]
pub enum Expression {
    Integer(i128),
    Real(f64),
    Text(String),
    Variable(Variable),
    Io { place: Place, width: Width, number: Box<Expression> },
    ErrorMessage(Box<Expression>),
    State(State),
    Point(Box<Point>),
    Negative(Box<Expression>),
    Calculation { operator: Operator, left: Box<Expression>, right: Box<Expression> },
}

/// What a function without parameters gives.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum State {
    LastError,
    Motor,
    Power,
    Speed,
    SpeedFactor,
    Robot,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Operator {
    Add,
    Subtract,
    Multiply,
    Divide,
}

/// A backup variable, or an element of one.
#[derive(Debug, Clone, PartialEq)]
pub struct Variable {
    pub name: String,
    /// Empty for a scalar.
    pub element: Vec<Expression>,
}

/// A place to go to.
#[derive(Debug, Clone, PartialEq)]
pub struct Point {
    pub base: PointBase,
    pub changes: Vec<PointChange>,
}

#[derive(Debug, Clone, PartialEq)]
pub enum PointBase {
    /// Of the project.
    Number(Expression),
    /// Where the motion control wants the robot to be.
    Here,
    /// Where the robot is.
    RealPos,
    /// X, Y, Z, U, and V and W unless they are 0.
    Coordinates(Vec<Expression>),
}

/// `+Z(10)`, `-Z(10)` or `:Z(10)`.
#[derive(Debug, Clone, PartialEq)]
pub struct PointChange {
    /// 0 for X to 5 for W.
    pub axis: usize,
    pub kind: ChangeKind,
    pub value: Expression,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ChangeKind {
    Plus,
    Minus,
    Absolute,
}
