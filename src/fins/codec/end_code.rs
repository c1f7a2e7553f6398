//! End codes: how a command ended (W342 5-1-3).

use std::fmt;

/// The end code of a response: main and sub code (MRES and SRES), and three flags beside them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct EndCode {
    /// Main code in the high byte, sub code in the low byte, without the flags.
    pub code: u16,
    /// An error occurred while a network on the way relayed the command (bit 7 of MRES).
    pub is_relay_error: bool,
    /// The PLC has a fatal error: it does not run (bit 7 of SRES).
    pub plc_has_fatal_error: bool,
    /// The PLC has an error that lets it run (bit 6 of SRES).
    pub plc_has_non_fatal_error: bool,
}

const RELAY: u16 = 0x8000;
const FATAL: u16 = 0x0080;
const NON_FATAL: u16 = 0x0040;

impl EndCode {
    /// Normal completion.
    pub const NORMAL: Self = Self::from_wire(0);

    /// The two bytes of a response.
    pub const fn from_wire(bytes: u16) -> Self {
        Self {
            code: bytes & !(RELAY | FATAL | NON_FATAL),
            is_relay_error: bytes & RELAY != 0,
            plc_has_fatal_error: bytes & FATAL != 0,
            plc_has_non_fatal_error: bytes & NON_FATAL != 0,
        }
    }

    /// The two bytes of a response.
    pub const fn to_wire(self) -> u16 {
        let relay = if self.is_relay_error { RELAY } else { 0 };
        let fatal = if self.plc_has_fatal_error { FATAL } else { 0 };
        let non_fatal = if self.plc_has_non_fatal_error { NON_FATAL } else { 0 };
        self.code | relay | fatal | non_fatal
    }

    /// Whether the command was executed. An error of the PLC itself does not stop it.
    pub const fn is_normal(self) -> bool {
        self.code == 0 && !self.is_relay_error
    }

    /// The row of the manual's table; `None` for a code that the table does not have.
    pub fn known(self) -> Option<KnownEndCode> {
        KnownEndCode::ALL.iter().copied().find(|known| known.value() == self.code)
    }

    /// Whether the command may have been executed although it was not confirmed: the answer was lost behind the node
    /// that reports it, or the execution was broken off.
    pub fn leaves_execution_open(self) -> bool {
        self.is_relay_error
            || matches!(
                self.known(),
                Some(KnownEndCode::ServiceCancelled | KnownEndCode::ResponseTimeout | KnownEndCode::ServiceAborted)
            )
    }
}

/// Four hexadecimal digits and the English text.
impl fmt::Display for EndCode {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:04X}", self.code)?;
        if let Some(known) = self.known() {
            write!(f, " {}", known.name())?;
        }
        if self.is_relay_error {
            f.write_str(", while a network relayed the command")?;
        }
        Ok(())
    }
}

impl From<KnownEndCode> for EndCode {
    fn from(known: KnownEndCode) -> Self {
        Self::from_wire(known.value())
    }
}

/// What can be done about an end code. Codes of one kind have the same remedy.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum EndCodeRemedy {
    /// Nothing is wrong.
    None,
    /// Try again; look at the program and the load of the PLC.
    Retry,
    /// Check the settings of the network unit.
    NetworkUnit,
    /// Check node, cable and power of the PLC.
    Destination,
    /// Check the error that the PLC or the unit shows.
    PlcError,
    /// The PLC does not offer this.
    Unsupported,
    /// Check the routing tables.
    Routing,
    /// This program and the PLC do not understand each other.
    Format,
    /// Check area, address and number of elements.
    Address,
    /// Remove the protection, or choose another area.
    Protection,
    /// Change the operating mode.
    Mode,
    /// Another device holds the access right.
    AccessRight,
    /// A file, table or device is missing in the PLC.
    Missing,
}

macro_rules! end_codes {
    ($($name:ident $value:literal $remedy:ident $text:literal;)*) => {
        /// The codes of the manual's table.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
        #[non_exhaustive]
        pub enum KnownEndCode {
            $(
                #[doc = $text]
                $name,
            )*
        }

        impl KnownEndCode {
            /// Every row of the table.
            pub const ALL: &'static [Self] = &[$(Self::$name),*];

            /// Main code in the high byte, sub code in the low byte.
            pub const fn value(self) -> u16 {
                match self { $(Self::$name => $value),* }
            }

            /// What can be done about it.
            pub const fn remedy(self) -> EndCodeRemedy {
                match self { $(Self::$name => EndCodeRemedy::$remedy),* }
            }

            /// A short text in English, for logs and programs.
            pub const fn name(self) -> &'static str {
                match self { $(Self::$name => $text),* }
            }
        }
    };
}

end_codes! {
    NormalCompletion 0x0000 None "normal completion";
    ServiceCancelled 0x0001 Retry "the service was cancelled";
    LocalNodeNotInNetwork 0x0101 NetworkUnit "the local node is not in the network";
    TokenTimeout 0x0102 NetworkUnit "no token in time";
    RetriesFailed 0x0103 Retry "all retries failed";
    TooManySendFrames 0x0104 Retry "too many frames to send";
    NodeAddressRange 0x0105 NetworkUnit "the node is out of range";
    NodeAddressDuplicate 0x0106 NetworkUnit "two nodes have the same address";
    DestinationNotInNetwork 0x0201 Destination "the destination node is not in the network";
    UnitMissing 0x0202 Destination "the destination unit is missing";
    ThirdNodeMissing 0x0203 Destination "the third node is missing";
    DestinationBusy 0x0204 Retry "the destination node is busy";
    ResponseTimeout 0x0205 Destination "no response in time";
    CommunicationsControllerError 0x0301 PlcError "error of the communications controller";
    CpuUnitError 0x0302 PlcError "error of the CPU unit";
    ControllerError 0x0303 PlcError "error of the controller";
    UnitNumberError 0x0304 PlcError "wrong unit number";
    UndefinedCommand 0x0401 Unsupported "the command is not defined";
    NotSupportedByModel 0x0402 Unsupported "the model or version does not support the command";
    DestinationNotInRoutingTable 0x0501 Routing "the destination is not in the routing tables";
    NoRoutingTables 0x0502 Routing "there are no routing tables";
    RoutingTableError 0x0503 Routing "error of the routing tables";
    TooManyRelays 0x0504 Routing "too many relays";
    CommandTooLong 0x1001 Format "the command is too long";
    CommandTooShort 0x1002 Format "the command is too short";
    ElementsAndDataDiffer 0x1003 Format "elements and data do not match";
    CommandFormatError 0x1004 Format "the command format is wrong";
    HeaderError 0x1005 Format "the header is wrong";
    AreaMissing 0x1101 Address "the memory area does not exist";
    AccessSizeError 0x1102 Address "wrong access size or odd address";
    AddressRangeError 0x1103 Address "the first address is outside the area";
    AddressRangeExceeded 0x1104 Address "the last address is outside the area";
    ProgramMissing 0x1106 Missing "the program does not exist";
    RelationalError 0x1109 Format "the parameters contradict each other";
    DuplicateDataAccess 0x110A Retry "the data is accessed twice at the same time";
    ResponseTooLong 0x110B Format "the response would be too long";
    ParameterError 0x110C Format "a parameter is wrong";
    ReadProtected 0x2002 Protection "the data is protected against reading";
    ReadTableMissing 0x2003 Missing "the table does not exist";
    ReadDataMissing 0x2004 Missing "the data does not exist";
    ReadProgramMissing 0x2005 Missing "the program to read does not exist";
    ReadFileMissing 0x2006 Missing "the file to read does not exist";
    DataMismatch 0x2007 Missing "the data does not match";
    ReadOnly 0x2101 Protection "the area is read-only";
    WriteProtected 0x2102 Protection "the data is protected against writing";
    CannotRegister 0x2103 Missing "it cannot be registered";
    WriteProgramMissing 0x2105 Missing "the program to write does not exist";
    WriteFileMissing 0x2106 Missing "the file to write does not exist";
    FileExists 0x2107 Missing "the file exists already";
    CannotChange 0x2108 Protection "it cannot be changed";
    NotDuringExecution 0x2201 Mode "not possible during execution";
    NotWhileRunning 0x2202 Mode "not possible while the PLC runs";
    WrongModeProgram 0x2203 Mode "not possible in PROGRAM mode";
    WrongModeDebug 0x2204 Mode "not possible in DEBUG mode";
    WrongModeMonitor 0x2205 Mode "not possible in MONITOR mode";
    WrongModeRun 0x2206 Mode "not possible in RUN mode";
    NotPollingNode 0x2207 NetworkUnit "the node is not the polling node";
    StepNotExecutable 0x2208 Mode "the step cannot be executed";
    FileDeviceMissing 0x2301 Missing "the file device does not exist";
    MemoryMissing 0x2302 Missing "the memory does not exist";
    ClockMissing 0x2303 Missing "the clock does not exist";
    StartTableMissing 0x2401 Missing "the table for starting does not exist";
    UnitMemoryError 0x2502 PlcError "memory error";
    IoSettingError 0x2503 PlcError "error of the I/O setting";
    TooManyIoPoints 0x2504 PlcError "too many I/O points";
    CpuBusError 0x2505 PlcError "error of the CPU bus";
    IoDuplication 0x2506 PlcError "an I/O address is used twice";
    IoBusError 0x2507 PlcError "error of the I/O bus";
    SysmacBus2Error 0x2509 PlcError "error of SYSMAC BUS/2";
    CpuBusUnitError 0x250A PlcError "error of a CPU bus unit";
    SysmacBusDuplication 0x250D PlcError "a SYSMAC BUS number is used twice";
    MemoryError 0x250F PlcError "error of the internal memory or memory card";
    TerminatorMissing 0x2510 PlcError "a SYSMAC BUS terminator is missing";
    NotProtected 0x2601 Protection "there is no protection";
    WrongPassword 0x2602 Protection "the password is wrong";
    Protected 0x2604 Protection "it is protected";
    AlreadyExecuting 0x2605 Retry "the service is executed already";
    ServiceStopped 0x2606 Retry "the service is stopped";
    NoExecutionRight 0x2607 AccessRight "there is no right to execute it";
    SettingsIncomplete 0x2608 NetworkUnit "the settings are not complete";
    ItemsNotSet 0x2609 NetworkUnit "necessary items are not set";
    NumberAlreadyDefined 0x260A Format "the number is defined already";
    ErrorNotCleared 0x260B PlcError "the error cannot be cleared";
    NoAccessRight 0x3001 AccessRight "another device holds the access right";
    ServiceAborted 0x4001 Retry "the service was aborted";
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_flags_stand_beside_the_code() {
        for bytes in [0x0000, 0x0040, 0x0080, 0x1103, 0x9143, 0x82C5] {
            assert_eq!(EndCode::from_wire(bytes).to_wire(), bytes);
        }
        let code = EndCode::from_wire(0x0040);
        assert!(code.is_normal() && code.plc_has_non_fatal_error && !code.plc_has_fatal_error);
        let code = EndCode::from_wire(0x8205);
        assert!(!code.is_normal() && code.is_relay_error && code.leaves_execution_open());
        assert_eq!(code.known(), Some(KnownEndCode::ResponseTimeout));
        assert_eq!(EndCode::from_wire(0x11C3).known(), Some(KnownEndCode::AddressRangeError));
        assert!(!EndCode::from_wire(0x1103).leaves_execution_open());
    }

    #[test]
    fn the_table_has_each_code_once_and_none_of_the_flags() {
        let mut values: Vec<u16> = KnownEndCode::ALL.iter().map(|known| known.value()).collect();
        assert!(values.iter().all(|value| value & (RELAY | FATAL | NON_FATAL) == 0));
        assert!(values.is_sorted());
        values.dedup();
        assert_eq!(values.len(), KnownEndCode::ALL.len());
        assert_eq!(EndCode::from_wire(0x0103).to_string(), "0103 all retries failed");
        assert_eq!(EndCode::from_wire(0x0F0F).to_string(), "0F0F");
    }
}
