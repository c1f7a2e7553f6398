//! The subset of SPEL+ that the remote command Execute runs.
//!
//! Statements, joined by `;`; words without regard to case; `'` begins a comment:
//!
//! | statement | effect |
//! |---|---|
//! | `Print` value, … | adds a line to the result, its values joined by a blank |
//! | `Where` | prints position, joint angles and pulses of the current robot |
//! | `On` bit, `Off` bit | output bit |
//! | `Out` port, value | output byte |
//! | `MemOn` bit, `MemOff` bit, `MemOut` port, value | the same of the memory I/O |
//! | `Motor On`, `Motor Off` | motors of the current robot; on means power low |
//! | `Power High`, `Power Low` | power of the current robot |
//! | `Speed` percent | speed of `Go` and `Jump`, 1–100; 5 after power-on, Reset and `Motor On` |
//! | `SpeedFactor` percent | 1–100 |
//! | `Robot` number | selects the current robot |
//! | `Go` point | motion from point to point |
//! | `Jump` point | as `Go`, but up to Z 0 first and down to the point last; SCARA only |
//! | `Home` | motion to the home position |
//! | variable `=` value | a backup variable or an element of one |
//!
//! Values: numbers (`1`, `0.5`, `&HFF`), texts in quotes, backup variables, `+ - * /` and brackets; the functions `Sw`, `In`,
//! `InW` (inputs), `Oport`, `Out`, `OutW` (outputs), `MemSw`, `MemIn`, `MemInW`, `ErrMsg$(number[, language])`, `Err` (the
//! number of the last error of an Execute), `Motor`, `Power`, `Speed`, `SpeedFactor`, `Robot`; and points.
//!
//! Points: `P`n or `P(`n`)` of the project (P0 is the home position, P1 and P2 are above and at the place where the robot
//! takes a part, P3 and P4 where it puts the part down), `Here`, `CurPos`, `RealPos`, `XY(x, y, z, u[, v, w])`; behind it any
//! number of `+X(mm)`, `-Z(mm)` for a distance and `:U(degrees)` for another coordinate.
//!
//! | file | idea |
//! |---|---|
//! | `error` | [`SpelError`](error::SpelError), its number and its text |
//! | `lexer` | text to tokens |
//! | `syntax` | statements, values and points |
//! | `parser` | tokens to statements |

pub(super) mod error;
mod lexer;
pub(super) mod parser;
pub(super) mod syntax;
