//! The motion log's blocks (manual 3.2.3.4 and 4.3): one read of the `Data` node brings whole blocks of 2608 bytes. A
//! block holds eight samples of encoders, current commands, real-time and standard I/O, and one sample of force sensor,
//! pulse counters and tool centre point.

mod block;
mod columns;
mod force_sensor;

pub use block::{
    AXES, BLOCK_BYTES, BlockView, DriveCommand, DriveCommandView, Encoder, EncoderView, MAX_BLOCKS_PER_READ,
    MotionBlock, MotionRead, PulseCounters, PulseCountersView, RealTimeIo, RealTimeIoView, SAMPLES, StandardIo,
    StandardIoView, TcpPosition, TcpPositionView,
};
pub use columns::{
    DriveColumns, EncoderColumns, ForceSensorColumns, IoColumns, MotionColumns, PulseColumns, TcpColumns,
};
pub use force_sensor::{Elements, ForceSensor, ForceSensorView, SixAxes};
