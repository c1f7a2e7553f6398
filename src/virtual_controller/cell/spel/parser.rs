use super::error::SpelError;
use super::lexer::{Placed, Token, tokens, unsupported};
use super::syntax::{
    ChangeKind, Expression, Operator, Place, Point, PointBase, PointChange, State, Statement, Variable, Width,
};

/// The longest text that Execute takes, in bytes (*10 of the remote commands).
pub const MAX_TEXT: usize = 256;

/// Brackets and signs within each other. A text of 256 bytes could hold more.
const MAX_DEPTH: usize = 24;

/// Reads the statements of a text. Nothing is executed unless all of them are understood.
pub fn parse(text: &str) -> Result<Vec<Statement>, SpelError> {
    if text.len() > MAX_TEXT {
        return Err(SpelError::TextTooLong);
    }
    let mut parser = Parser { text, tokens: tokens(text)?, at: 0, depth: 0 };
    let mut statements = Vec::new();
    loop {
        while parser.takes(';') {}
        if parser.peek().is_none() {
            return if statements.is_empty() { Err(parser.wrong()) } else { Ok(statements) };
        }
        statements.push(parser.statement()?);
        if parser.peek().is_some() {
            parser.expect(';')?;
        }
    }
}

struct Parser<'a> {
    text: &'a str,
    tokens: Vec<Placed>,
    at: usize,
    depth: usize,
}

impl Parser<'_> {
    fn statement(&mut self) -> Result<Statement, SpelError> {
        let start = self.at;
        let word = self.word()?;
        let is_assignment = matches!(self.peek(), Some(Token::Sign('=')));
        let place = |memory: bool| if memory { Place::Memory } else { Place::Output };
        let lower = word.to_ascii_lowercase();
        match lower.as_str() {
            _ if is_assignment => {}
            "print" => return Ok(Statement::Print(self.list()?)),
            "where" => return Ok(Statement::Where),
            "on" | "off" | "memon" | "memoff" => {
                let (place, on) = (place(lower.starts_with("mem")), lower.ends_with("on"));
                return Ok(Statement::Bit { place, bit: self.expression()?, on });
            }
            "out" | "memout" => {
                let port = self.expression()?;
                self.expect(',')?;
                return Ok(Statement::Byte { place: place(lower == "memout"), port, value: self.expression()? });
            }
            "motor" => return Ok(Statement::Motor { on: self.one_of("on", "off")? }),
            "power" => return Ok(Statement::Power { high: self.one_of("high", "low")? }),
            "speed" => return Ok(Statement::Speed(self.expression()?)),
            "speedfactor" => return Ok(Statement::SpeedFactor(self.expression()?)),
            "robot" => return Ok(Statement::Robot(self.expression()?)),
            "go" => return Ok(Statement::Go(self.point()?)),
            "jump" => return Ok(Statement::Jump(self.point()?)),
            "home" => return Ok(Statement::Home),
            _ => {}
        }
        let element = self.arguments()?;
        if !self.takes('=') {
            self.at = start;
            return Err(self.wrong());
        }
        Ok(Statement::Assign { variable: Variable { name: word, element }, value: self.expression()? })
    }

    /// Products and quotients, added and subtracted.
    fn expression(&mut self) -> Result<Expression, SpelError> {
        self.nested(|parser| {
            let mut left = parser.product()?;
            loop {
                let operator = match parser.peek() {
                    Some(Token::Sign('+')) => Operator::Add,
                    Some(Token::Sign('-')) => Operator::Subtract,
                    _ => return Ok(left),
                };
                parser.at += 1;
                left = calculation(operator, left, parser.product()?);
            }
        })
    }

    fn product(&mut self) -> Result<Expression, SpelError> {
        let mut left = self.factor()?;
        loop {
            let operator = match self.peek() {
                Some(Token::Sign('*')) => Operator::Multiply,
                Some(Token::Sign('/')) => Operator::Divide,
                _ => return Ok(left),
            };
            self.at += 1;
            left = calculation(operator, left, self.factor()?);
        }
    }

    fn factor(&mut self) -> Result<Expression, SpelError> {
        if self.takes('-') {
            return self.nested(|parser| Ok(Expression::Negative(Box::new(parser.factor()?))));
        }
        if self.takes('(') {
            let inside = self.expression()?;
            self.expect(')')?;
            return Ok(inside);
        }
        let start = self.at;
        match self.peek().cloned() {
            Some(Token::Integer(number)) => {
                self.at += 1;
                Ok(Expression::Integer(number))
            }
            Some(Token::Real(number)) => {
                self.at += 1;
                Ok(Expression::Real(number))
            }
            Some(Token::Text(text)) => {
                self.at += 1;
                Ok(Expression::Text(text))
            }
            Some(Token::Word(word)) => {
                if let Some(base) = self.point_base()? {
                    return Ok(Expression::Point(Box::new(self.changed(base)?)));
                }
                self.at = start + 1;
                self.named(word)
            }
            _ => Err(self.wrong()),
        }
    }

    /// A function or a variable.
    fn named(&mut self, word: String) -> Result<Expression, SpelError> {
        let io = match word.to_ascii_lowercase().as_str() {
            "sw" => Some((Place::Input, Width::Bit)),
            "in" => Some((Place::Input, Width::Byte)),
            "inw" => Some((Place::Input, Width::Word)),
            "oport" => Some((Place::Output, Width::Bit)),
            "out" => Some((Place::Output, Width::Byte)),
            "outw" => Some((Place::Output, Width::Word)),
            "memsw" => Some((Place::Memory, Width::Bit)),
            "memin" => Some((Place::Memory, Width::Byte)),
            "meminw" => Some((Place::Memory, Width::Word)),
            "errmsg$" => {
                self.expect('(')?;
                let number = Box::new(self.expression()?);
                // There is one language.
                if self.takes(',') {
                    self.expression()?;
                }
                self.expect(')')?;
                return Ok(Expression::ErrorMessage(number));
            }
            "err" => return Ok(Expression::State(State::LastError)),
            "motor" => return Ok(Expression::State(State::Motor)),
            "power" => return Ok(Expression::State(State::Power)),
            "speed" => return Ok(Expression::State(State::Speed)),
            "speedfactor" => return Ok(Expression::State(State::SpeedFactor)),
            "robot" => return Ok(Expression::State(State::Robot)),
            _ => None,
        };
        match io {
            Some((place, width)) => {
                self.expect('(')?;
                let number = Box::new(self.expression()?);
                self.expect(')')?;
                Ok(Expression::Io { place, width, number })
            }
            None => Ok(Expression::Variable(Variable { name: word, element: self.arguments()? })),
        }
    }

    fn point(&mut self) -> Result<Point, SpelError> {
        match self.point_base()? {
            Some(base) => self.changed(base),
            None => Err(self.wrong()),
        }
    }

    /// What a point begins with, if the next word does.
    fn point_base(&mut self) -> Result<Option<PointBase>, SpelError> {
        let Some(Token::Word(word)) = self.peek() else { return Ok(None) };
        let lower = word.to_ascii_lowercase();
        let number = lower.strip_prefix('p').and_then(|digits| digits.parse::<u32>().ok());
        let before = self.at;
        self.at += 1;
        Ok(Some(match lower.as_str() {
            "here" | "curpos" => PointBase::Here,
            "realpos" => PointBase::RealPos,
            "xy" => {
                let coordinates = self.arguments()?;
                if !matches!(coordinates.len(), 4 | 6) {
                    self.at = before;
                    return Err(self.wrong());
                }
                PointBase::Coordinates(coordinates)
            }
            "p" if matches!(self.peek(), Some(Token::Sign('('))) => {
                self.expect('(')?;
                let number = self.expression()?;
                self.expect(')')?;
                PointBase::Number(number)
            }
            _ => match number {
                Some(number) => PointBase::Number(Expression::Integer(number.into())),
                None => {
                    self.at = before;
                    return Ok(None);
                }
            },
        }))
    }

    /// The changes behind a point: `+X(1)`, `:U(90)`. Another `+` or `-` belongs to what follows.
    fn changed(&mut self, base: PointBase) -> Result<Point, SpelError> {
        let mut changes = Vec::new();
        loop {
            let kind = match self.peek() {
                Some(Token::Sign('+')) => ChangeKind::Plus,
                Some(Token::Sign('-')) => ChangeKind::Minus,
                Some(Token::Sign(':')) => ChangeKind::Absolute,
                _ => return Ok(Point { base, changes }),
            };
            let axis = match self.tokens.get(self.at + 1) {
                Some((_, Token::Word(axis))) if axis.len() == 1 => "XYZUVW".find(&axis.to_ascii_uppercase()),
                _ => None,
            };
            let opens = matches!(self.tokens.get(self.at + 2), Some((_, Token::Sign('('))));
            let Some(axis) = axis.filter(|_| opens) else { return Ok(Point { base, changes }) };
            self.at += 3;
            let value = self.expression()?;
            self.expect(')')?;
            changes.push(PointChange { axis, kind, value });
        }
    }

    /// What is between brackets, if there are any.
    fn arguments(&mut self) -> Result<Vec<Expression>, SpelError> {
        if !self.takes('(') {
            return Ok(Vec::new());
        }
        let list = self.list()?;
        self.expect(')')?;
        Ok(list)
    }

    /// At least one expression.
    fn list(&mut self) -> Result<Vec<Expression>, SpelError> {
        let mut list = vec![self.expression()?];
        while self.takes(',') {
            list.push(self.expression()?);
        }
        Ok(list)
    }

    fn one_of(&mut self, yes: &str, no: &str) -> Result<bool, SpelError> {
        let start = self.at;
        let word = self.word()?;
        if word.eq_ignore_ascii_case(yes) {
            Ok(true)
        } else if word.eq_ignore_ascii_case(no) {
            Ok(false)
        } else {
            self.at = start;
            Err(self.wrong())
        }
    }

    fn nested<T>(&mut self, parse: impl FnOnce(&mut Self) -> Result<T, SpelError>) -> Result<T, SpelError> {
        if self.depth == MAX_DEPTH {
            return Err(self.wrong());
        }
        self.depth += 1;
        let parsed = parse(self);
        self.depth -= 1;
        parsed
    }

    fn word(&mut self) -> Result<String, SpelError> {
        match self.peek() {
            Some(Token::Word(word)) => {
                let word = word.clone();
                self.at += 1;
                Ok(word)
            }
            _ => Err(self.wrong()),
        }
    }

    fn takes(&mut self, sign: char) -> bool {
        let is_next = matches!(self.peek(), Some(Token::Sign(next)) if *next == sign);
        self.at += usize::from(is_next);
        is_next
    }

    fn expect(&mut self, sign: char) -> Result<(), SpelError> {
        if self.takes(sign) { Ok(()) } else { Err(self.wrong()) }
    }

    fn peek(&self) -> Option<&Token> {
        self.tokens.get(self.at).map(|(_, token)| token)
    }

    /// The next token is not what it should be.
    fn wrong(&self) -> SpelError {
        unsupported(self.tokens.get(self.at).map_or("", |(at, _)| &self.text[*at..]))
    }
}

fn calculation(operator: Operator, left: Expression, right: Expression) -> Expression {
    Expression::Calculation { operator, left: Box::new(left), right: Box::new(right) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn one(text: &str) -> Statement {
        let mut statements = parse(text).unwrap_or_else(|error| panic!("{text}: {error}"));
        assert_eq!(statements.len(), 1, "{text}");
        statements.remove(0)
    }

    fn unsupported_at(text: &str) -> String {
        match parse(text) {
            Err(SpelError::Unsupported(rest)) => rest,
            other => panic!("{text}: {other:?}"),
        }
    }

    #[test]
    fn every_statement_in_any_case() {
        let bit = |place, on| Statement::Bit { place, bit: Expression::Integer(9), on };
        assert_eq!(one("on 9"), bit(Place::Output, true));
        assert_eq!(one("OFF 9"), bit(Place::Output, false));
        assert_eq!(one("MemOn 9 ' comment"), bit(Place::Memory, true));
        assert_eq!(one("memoff(9)"), bit(Place::Memory, false));
        let byte = |place| Statement::Byte { place, port: Expression::Integer(1), value: Expression::Integer(255) };
        assert_eq!(one("Out 1, &HFF"), byte(Place::Output));
        assert_eq!(one("MemOut 1,255"), byte(Place::Memory));
        assert_eq!(one("Motor On"), Statement::Motor { on: true });
        assert_eq!(one("power low;"), Statement::Power { high: false });
        assert_eq!(one(";;where"), Statement::Where);
        assert_eq!(one("Home"), Statement::Home);
        assert_eq!(one("Speed 50"), Statement::Speed(Expression::Integer(50)));
        assert_eq!(one("SpeedFactor 50"), Statement::SpeedFactor(Expression::Integer(50)));
        assert_eq!(one("Robot 2"), Statement::Robot(Expression::Integer(2)));
        let both = parse("print Oport(1);print \"mark").unwrap();
        assert_eq!(both[1], Statement::Print(vec![Expression::Text("mark".to_owned())]));
    }

    #[test]
    fn points_with_their_changes() {
        let point = |text: &str| match one(&format!("Go {text}")) {
            Statement::Go(point) => point,
            other => panic!("{other:?}"),
        };
        assert_eq!(point("P3").base, PointBase::Number(Expression::Integer(3)));
        assert_eq!(point("p(1 + 2)").changes, []);
        assert_eq!(point("curpos").base, PointBase::Here);
        let moved = point("here +x(-1) -Z(2.5):U(90)");
        assert_eq!(
            moved.changes.iter().map(|it| (it.axis, it.kind)).collect::<Vec<_>>(),
            [(0, ChangeKind::Plus), (2, ChangeKind::Minus), (3, ChangeKind::Absolute)]
        );
        assert!(matches!(point("XY(1,2,3,4)").base, PointBase::Coordinates(list) if list.len() == 4));
        assert!(matches!(one("Jump P1"), Statement::Jump(_)));
        assert!(matches!(one("Print RealPos, P1"), Statement::Print(list) if list.len() == 2));
    }

    #[test]
    fn products_come_before_sums_and_brackets_before_both() {
        let value = |text: &str| match one(&format!("x = {text}")) {
            Statement::Assign { value, .. } => value,
            other => panic!("{other:?}"),
        };
        let number = Expression::Integer;
        let product = calculation(Operator::Multiply, number(2), number(3));
        assert_eq!(value("1 + 2 * 3"), calculation(Operator::Add, number(1), product));
        let sum = calculation(Operator::Subtract, number(1), number(2));
        assert_eq!(value("(1 - 2) / 3"), calculation(Operator::Divide, sum, number(3)));
        assert_eq!(value("-1"), Expression::Negative(Box::new(number(1))));
        assert!(matches!(one("g_List(1, 2) = 3"), Statement::Assign { variable, .. } if variable.element.len() == 2));
        // A statement's word can be the name of a variable.
        assert!(matches!(one("Speed = 3"), Statement::Assign { variable, .. } if variable.name == "Speed"));
    }

    #[test]
    fn what_is_not_understood_is_shown_from_there_on() {
        for (text, rest) in [
            ("", ""),
            (";", ""),
            ("Dance 3", "Dance 3"),
            ("Motor Up", "Up"),
            ("On", ""),
            ("On 1 2", "2"),
            ("Out 1", ""),
            ("Print 1,", ""),
            ("Print (1", ""),
            ("Go 5", "5"),
            ("Go XY(1,2,3)", "XY(1,2,3)"),
            ("Print ErrMsg$", ""),
            ("Where 1", "1"),
            ("1 = x", "1 = x"),
        ] {
            assert_eq!(unsupported_at(text), rest, "{text}");
        }
        assert_eq!(parse(&"x".repeat(257)), Err(SpelError::TextTooLong));
        assert!(parse(&format!("Print {}1", "-".repeat(200))).is_err());
        assert!(parse(&format!("Print {}1{}", "(".repeat(100), ")".repeat(100))).is_err());
        assert!(parse(&format!("Print {}1{}", "(".repeat(20), ")".repeat(20))).is_ok());
    }
}
