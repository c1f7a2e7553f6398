/// The form of a command's good answer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum ReplyKind {
    /// Only that it was done.
    Nothing,
    /// The number of a robot.
    Robot,
    /// One bit of I/O.
    Bit,
    /// Eight bits of I/O.
    Byte,
    /// Sixteen bits of I/O.
    Word,
    /// Values of a variable, in its type.
    Values,
    /// States and code.
    Status,
    /// The result of Execute, if there is one.
    Output,
    /// A count, and so many numbers of alarms.
    Alarms,
    /// One text; text form only.
    Text,
    /// Several texts; text form only.
    List,
}
