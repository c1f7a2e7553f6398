//! Values of the SPEL+ subset: expressions and points, calculated for the cell as it is.

use std::fmt;

use super::io::{IoDirection, find_bit};
use super::kinematics::{Joints, Posture, forward, inverse, posture};
use super::simulation::Cell;
use super::snapshot::Pose;
use super::spel::error::{SpelError, error_message};
use super::spel::syntax::{ChangeKind, Expression, Operator, Place, Point, PointBase, State, Variable, Width};
use super::variables::VariableError;
use crate::model::{SpelType, SpelValue};
use crate::remote::value_from_text;

/// The highest number of a point.
const MAX_POINT: i128 = 999;

/// A calculated value.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Value {
    Integer(i128),
    Real(f64),
    Text(String),
    Point { pose: Pose, posture: Posture },
}

/// As Print shows it. A point begins with a blank: ` X:  100.000 Y: … /R /0`, its numbers nine characters wide, then the
/// posture of the arm and the number of the local coordinate system.
impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Integer(number) => number.fmt(f),
            Self::Real(number) => number.fmt(f),
            Self::Text(text) => f.write_str(text),
            Self::Point { pose, posture } => {
                for (name, value) in ["X", "Y", "Z", "U", "V", "W"].iter().zip(pose.to_array()) {
                    write!(f, " {name}:{:9.3}", without_negative_zero(value))?;
                }
                write!(f, " {posture} /0")
            }
        }
    }
}

impl From<VariableError> for SpelError {
    fn from(error: VariableError) -> Self {
        match error {
            VariableError::Unknown => Self::UnknownVariable,
            VariableError::Dimensions | VariableError::Element => Self::Element,
            VariableError::Value => Self::WrongType,
        }
    }
}

impl Value {
    fn number(self) -> Result<f64, SpelError> {
        match self {
            // Rounded where the number is larger than 2⁵³.
            Self::Integer(number) => Ok(number as f64),
            Self::Real(number) => Ok(number),
            Self::Text(_) | Self::Point { .. } => Err(SpelError::WrongType),
        }
    }

    /// What a variable of this type holds. Unlike the program's own assignments, a number out of range is an error.
    pub fn for_variable(self, kind: SpelType) -> Result<SpelValue, SpelError> {
        let value = match (kind, self) {
            (SpelType::String, Self::Text(text)) => return Ok(SpelValue::String(text)),
            (SpelType::String, _) | (_, Self::Text(_) | Self::Point { .. }) => return Err(SpelError::WrongType),
            (SpelType::Boolean, value) => return Ok(SpelValue::Boolean(value.number()? != 0.0)),
            (SpelType::Real | SpelType::Double, value) => return Ok(kind.of_number(value.number()?)),
            (_, Self::Integer(number)) => number,
            (_, Self::Real(number)) => {
                let rounded = number.round();
                // Within this range a Double holds every whole number.
                if rounded.abs() > 9.0e15 || rounded.is_nan() {
                    return Err(SpelError::OutOfRange);
                }
                rounded as i128
            }
        };
        value_from_text(kind, &value.to_string()).map_err(|_| SpelError::OutOfRange)
    }
}

impl Cell {
    pub(super) fn evaluate(&self, expression: &Expression) -> Result<Value, SpelError> {
        match expression {
            Expression::Integer(number) => Ok(Value::Integer(*number)),
            Expression::Real(number) => Ok(Value::Real(*number)),
            Expression::Text(text) => Ok(Value::Text(text.clone())),
            Expression::Variable(Variable { name, element }) => {
                let element = self.element(element)?;
                let values = self.variables.read(name, None, &element, 1)?;
                Ok(values.first().map_or(Value::Integer(0), of_variable))
            }
            Expression::Io { place, width, number } => {
                let number = self.whole(number)?;
                self.io_value(*place, *width, number).map(Value::Integer)
            }
            Expression::ErrorMessage(number) => {
                let number = u16::try_from(self.whole(number)?).map_err(|_| SpelError::OutOfRange)?;
                Ok(Value::Text(error_message(number).to_owned()))
            }
            Expression::State(state) => Ok(Value::Integer(self.state(*state))),
            Expression::Point(point) => {
                let (pose, joints) = self.pose(point)?;
                let model = self.robots[self.current_robot].robot.model();
                let now = self.robots[self.current_robot].robot.command(self.now).position;
                let joints = joints.or_else(|| inverse(model, pose, &now)).unwrap_or(now);
                Ok(Value::Point { pose, posture: posture(model, &joints) })
            }
            Expression::Negative(value) => match self.evaluate(value)? {
                Value::Integer(number) => number.checked_neg().map(Value::Integer).ok_or(SpelError::OutOfRange),
                value => Ok(Value::Real(-value.number()?)),
            },
            Expression::Calculation { operator, left, right } => {
                calculate(*operator, self.evaluate(left)?, self.evaluate(right)?)
            }
        }
    }

    /// A whole number; a decimal one is rounded.
    pub(super) fn whole(&self, expression: &Expression) -> Result<i128, SpelError> {
        match self.evaluate(expression)? {
            Value::Integer(number) => Ok(number),
            value => {
                let number = value.number()?.round();
                if number.abs() < 9.0e15 { Ok(number as i128) } else { Err(SpelError::OutOfRange) }
            }
        }
    }

    /// The numbers of an element; empty for a scalar.
    pub(super) fn element(&self, numbers: &[Expression]) -> Result<Vec<u16>, SpelError> {
        let number = |expression| u16::try_from(self.whole(expression)?).map_err(|_| SpelError::Element);
        numbers.iter().map(number).collect()
    }

    /// The index of a port and the place of a bit or byte in it.
    pub(super) fn io_place(&self, place: Place, width: Width, number: i128) -> Result<(usize, u16), SpelError> {
        let (bits, error) = match (place, width) {
            (Place::Memory, Width::Bit) => (1, SpelError::MemoryBit),
            (Place::Memory, Width::Byte) => (8, SpelError::MemoryByte),
            (Place::Memory, Width::Word) => (16, SpelError::MemoryWord),
            (_, Width::Bit) => (1, SpelError::IoBit),
            (_, Width::Byte) => (8, SpelError::IoByte),
            (_, Width::Word) => (16, SpelError::IoWord),
        };
        let direction = match place {
            Place::Input => IoDirection::Input,
            Place::Output => IoDirection::Output,
            Place::Memory => IoDirection::Memory,
        };
        let first = u32::try_from(number).ok().and_then(|number| number.checked_mul(bits));
        let found = first.and_then(|first| find_bit(self.description.io, direction, first));
        // Not more than 16.
        found.map(|(port, bit)| (port, bit / bits as u16)).ok_or(error)
    }

    fn io_value(&self, place: Place, width: Width, number: i128) -> Result<i128, SpelError> {
        let (port, offset) = self.io_place(place, width, number)?;
        Ok(match width {
            Width::Bit => self.io.bit(port, offset).into(),
            Width::Byte => self.io.byte(port, offset).into(),
            Width::Word => self.io.word(port, offset).into(),
        })
    }

    fn state(&self, state: State) -> i128 {
        let unit = &self.robots[self.current_robot];
        match state {
            State::LastError => self.last_error.into(),
            State::Motor => unit.robot.state().motors_on.into(),
            State::Power => unit.robot.state().power_high.into(),
            State::Speed => unit.speed.into(),
            State::SpeedFactor => unit.speed_factor.into(),
            // At most four robots.
            State::Robot => self.current_robot as i128 + 1,
        }
    }

    /// The joints for a point of the current robot.
    pub(super) fn joints(&self, point: &Point) -> Result<Joints, SpelError> {
        let (pose, joints) = self.pose(point)?;
        if let Some(joints) = joints {
            return Ok(joints);
        }
        let robot = &self.robots[self.current_robot].robot;
        inverse(robot.model(), pose, &robot.command(self.now).position).ok_or(SpelError::OutOfReach)
    }

    /// A point, and its joints where these are known and nothing was changed.
    fn pose(&self, point: &Point) -> Result<(Pose, Option<Joints>), SpelError> {
        let robot = &self.robots[self.current_robot].robot;
        let of_joints = |joints: Joints| (forward(robot.model(), &joints), Some(joints));
        let (pose, joints) = match &point.base {
            PointBase::Here => of_joints(robot.command(self.now).position),
            PointBase::RealPos => of_joints(robot.actual(self.now).position),
            PointBase::Number(number) => {
                let number = self.whole(number)?;
                if !(0..=MAX_POINT).contains(&number) {
                    return Err(SpelError::PointNumber);
                }
                let points = self.program.points.get(self.current_robot);
                let joints = usize::try_from(number).ok().and_then(|number| points?.get(number));
                of_joints(*joints.ok_or(SpelError::UndefinedPoint)?)
            }
            PointBase::Coordinates(list) => {
                let mut values = [0.0; 6];
                for (value, expression) in values.iter_mut().zip(list) {
                    *value = self.coordinate(expression)?;
                }
                (pose_of(values), None)
            }
        };
        if point.changes.is_empty() {
            return Ok((pose, joints));
        }
        let mut values = pose.to_array();
        for change in &point.changes {
            let by = self.coordinate(&change.value)?;
            let value = &mut values[change.axis];
            match change.kind {
                ChangeKind::Plus => *value += by,
                ChangeKind::Minus => *value -= by,
                ChangeKind::Absolute => *value = by,
            }
        }
        Ok((pose_of(values), None))
    }

    /// Millimetres or degrees.
    fn coordinate(&self, expression: &Expression) -> Result<f64, SpelError> {
        let value = self.evaluate(expression)?.number()?;
        if value.abs() < 1e5 { Ok(value) } else { Err(SpelError::OutOfRange) }
    }
}

fn of_variable(value: &SpelValue) -> Value {
    match value {
        SpelValue::Boolean(value) => Value::Integer((*value).into()),
        SpelValue::Int8(value) => Value::Integer((*value).into()),
        SpelValue::Int16(value) => Value::Integer((*value).into()),
        SpelValue::Int32(value) => Value::Integer((*value).into()),
        SpelValue::Int64(value) => Value::Integer((*value).into()),
        SpelValue::UInt8(value) => Value::Integer((*value).into()),
        SpelValue::UInt16(value) => Value::Integer((*value).into()),
        SpelValue::UInt32(value) => Value::Integer((*value).into()),
        SpelValue::UInt64(value) => Value::Integer((*value).into()),
        SpelValue::Float(value) => Value::Real((*value).into()),
        SpelValue::Double(value) => Value::Real(*value),
        SpelValue::String(value) => Value::Text(value.clone()),
    }
}

fn calculate(operator: Operator, left: Value, right: Value) -> Result<Value, SpelError> {
    match (operator, left, right) {
        (Operator::Add, Value::Text(mut left), Value::Text(right)) => {
            left.push_str(&right);
            Ok(Value::Text(left))
        }
        (Operator::Divide, left, right) => {
            let by = right.number()?;
            if by == 0.0 { Err(SpelError::DivisionByZero) } else { Ok(whole_if_so(left.number()? / by)) }
        }
        (operator, Value::Integer(left), Value::Integer(right)) => {
            let result = match operator {
                Operator::Add => left.checked_add(right),
                Operator::Subtract => left.checked_sub(right),
                Operator::Multiply | Operator::Divide => left.checked_mul(right),
            };
            result.map(Value::Integer).ok_or(SpelError::OutOfRange)
        }
        (operator, left, right) => {
            let (left, right) = (left.number()?, right.number()?);
            Ok(Value::Real(match operator {
                Operator::Add => left + right,
                Operator::Subtract => left - right,
                Operator::Multiply | Operator::Divide => left * right,
            }))
        }
    }
}

/// 6 / 3 is 2, not 2.0: both print the same.
fn whole_if_so(number: f64) -> Value {
    if number.fract() == 0.0 && number.abs() < 9.0e15 { Value::Integer(number as i128) } else { Value::Real(number) }
}

const fn pose_of([x, y, z, u, v, w]: [f64; 6]) -> Pose {
    Pose { x, y, z, u, v, w }
}

/// −0.0004 is printed as 0.000.
pub(super) fn without_negative_zero(value: f64) -> f64 {
    if value.abs() < 0.000_5 { 0.0 } else { value }
}
