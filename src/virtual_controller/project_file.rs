//! The file of a controller's project that declares the backup variables for OPC UA (manual 4.2) and for remote commands, in
//! the controller's folder.

use std::fs::File;
use std::io::{self, Read as _, Write as _};
use std::path::{Path, PathBuf};

use super::cell::{MAX_DECLARATION_BYTES, SpelDeclaration, SpelDeclarations};
use crate::platform::private;

/// The file with the declarations. An engineer may edit it; the OPC UA server reads it when it starts.
pub(super) fn path(folder: &Path) -> PathBuf {
    folder.join("project").join("Variables.inc")
}

/// Writes the usual declarations if there is no file yet.
pub(super) fn provide(folder: &Path) -> io::Result<()> {
    let path = path(folder);
    private::create_folder(&folder.join("project"))?;
    match private::create_file(&path) {
        Ok(mut file) => file.write_all(USUAL.as_bytes()),
        Err(error) if error.kind() == io::ErrorKind::AlreadyExists => Ok(()),
        Err(error) => Err(error),
    }
}

/// Reads the declarations. Without a file there are none.
pub(super) fn load(folder: &Path) -> io::Result<SpelDeclarations> {
    let mut content = Vec::new();
    match File::open(path(folder)) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(SpelDeclarations::default()),
        // One byte more than is looked at says that there is more.
        file => file?.take(MAX_DECLARATION_BYTES as u64 + 1).read_to_end(&mut content)?,
    };
    Ok(SpelDeclarations::parse(&content))
}

/// The variables of a new virtual controller.
pub fn usual_variables() -> Vec<SpelDeclaration> {
    SpelDeclarations::parse(USUAL.as_bytes()).variables
}

/// The example of the manual (4.2.2), one variable of each other type, and those of the remote commands' examples. The program of the cell assigns them.
const USUAL: &str = "\
' Variables that OPC UA clients can read: Global Preserve, with the prefix OPCUA_, no arrays, 256 at most.
' Remote commands read and set every Global Preserve variable. The OPC UA server reads this file when it starts.
Global Preserve UShort OPCUA_ItemCode
Global Preserve UInt32 OPCUA_ElectricPower
Global Preserve UInt32 OPCUA_NumOfProduced
Global Preserve UInt32 OPCUA_NumOfNonDefective
Global Preserve UShort OPCUA_CycleTime
Global Preserve UInt32 OPCUA_ConsumedStatus
Global Preserve UShort OPCUA_OperatingStatus
Global Preserve UInt32 OPCUA_ErrorCode
Global Preserve Boolean OPCUA_PartIsGood
Global Preserve Byte OPCUA_Shift
Global Preserve Short OPCUA_DeviationX, OPCUA_DeviationY
Global Preserve Integer OPCUA_Pallet
Global Preserve Long OPCUA_TargetDifference
Global Preserve Int32 OPCUA_UptimeSeconds
Global Preserve Int64 OPCUA_UptimeMilliseconds
Global Preserve UByte OPCUA_PalletPlace
Global Preserve UInt64 OPCUA_PartSerial
Global Preserve Real OPCUA_CycleSeconds
Global Preserve Double OPCUA_Load
Global Preserve String OPCUA_Recipe
Global Preserve Integer g_Status, g_intArray(10), g_int3Array(10, 10, 10)
";

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;
    use crate::virtual_controller::cell::SpelType;

    #[test]
    fn the_usual_file_declares_every_type_and_is_kept_once_it_was_edited() {
        let folder = tempfile::tempdir().unwrap();
        assert_eq!(load(folder.path()).unwrap(), SpelDeclarations::default());
        provide(folder.path()).unwrap();
        let usual = load(folder.path()).unwrap();
        assert_eq!(usual.findings, []);
        for kind in SpelType::ALL {
            assert!(usual.variables.iter().any(|variable| variable.kind == kind), "{kind}");
        }
        assert!(private::is_private(&path(folder.path())));
        fs::write(path(folder.path()), "Global Preserve Byte OPCUA_Own\nnonsense").unwrap();
        provide(folder.path()).unwrap();
        let own = load(folder.path()).unwrap();
        assert_eq!((own.variables.len(), own.findings.len()), (1, 1));
    }

    #[test]
    fn no_more_of_a_file_is_read_than_is_looked_at() {
        let folder = tempfile::tempdir().unwrap();
        provide(folder.path()).unwrap();
        let file = fs::File::create(path(folder.path())).unwrap();
        file.set_len(1 << 40).unwrap();
        assert_eq!(load(folder.path()).unwrap().findings.len(), 1);
    }
}
