//! The force sensor's packets (manual 3.2.3.2 and 4.1): a recording is one header, data records, and one footer; all carry
//! the id of the recording. One read of a `Data` node brings a header, or data records, or a footer.

mod assembly;
mod columns;
mod data;
mod footer;
mod header;
mod read;

pub use assembly::{ForceAssembly, ForceEvent};
pub use columns::ForceColumns;
pub use data::{
    AllData, AllView, DataHead, ForceAndPosition, ForceData, ForceDataType, ForceView, Forces, ForcesView, HeadView,
    MotionData, MotionView, PositionData, PositionView, SpeedView, TcpSpeed,
};
pub use footer::{EndCondition, FooterView, ForceFooter};
pub use header::{ForceHeader, HEADER_V1_BYTES, HEADER_V2_BYTES, Header, HeaderView};
pub use read::{DataRecords, ForceRead};

/// OPCUACommonTag of a header.
pub const TAG_HEADER: u8 = 1;
/// OPCUACommonTag of a data record.
pub const TAG_DATA: u8 = 2;
/// OPCUACommonTag of a footer.
pub const TAG_FOOTER: u8 = 4;
