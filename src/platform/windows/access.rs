//! Files and folders with an access control list for this account, made with it from the start.

use std::fs::File;
use std::io;
use std::os::windows::io::{FromRawHandle as _, OwnedHandle};
use std::path::Path;
use std::ptr::null_mut;

use windows_sys::Win32::Foundation::{GENERIC_READ, GENERIC_WRITE, HANDLE, INVALID_HANDLE_VALUE, LocalFree};
use windows_sys::Win32::Security::Authorization::{
    ConvertSidToStringSidW, ConvertStringSecurityDescriptorToSecurityDescriptorW, SDDL_REVISION_1,
};
use windows_sys::Win32::Security::{
    GetTokenInformation, PSECURITY_DESCRIPTOR, SECURITY_ATTRIBUTES, TOKEN_QUERY, TOKEN_USER, TokenUser,
};
use windows_sys::Win32::Storage::FileSystem::{
    CREATE_NEW, CreateDirectoryW, CreateFileW, FILE_ATTRIBUTE_NORMAL, FILE_FLAG_DELETE_ON_CLOSE, FILE_SHARE_DELETE,
    FILE_SHARE_READ, FILE_SHARE_WRITE, OPEN_ALWAYS,
};
use windows_sys::Win32::System::Threading::{GetCurrentProcess, OpenProcessToken};

use super::{succeeded, wide, wide_path};

/// How [`open_file`] opens.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Open {
    /// Creates; fails if there is one.
    New,
    /// Creates if there is none; leaves the content.
    Any,
    /// Creates; removed by the system when the last handle is closed, even if the process is killed.
    Temporary,
}

/// See [`crate::platform::private::create_folder`].
pub fn create_folder(path: &Path) -> io::Result<()> {
    let path = std::path::absolute(path)?;
    let descriptor = Descriptor::private()?;
    let mut missing: Vec<&Path> = path.ancestors().take_while(|folder| !folder.exists()).collect();
    while let Some(folder) = missing.pop() {
        let is_drive_root = |parent: &Path| parent.parent().is_none();
        let made = if !missing.is_empty() && folder.parent().is_some_and(is_drive_root) {
            std::fs::create_dir(folder)
        } else {
            let (name, attributes) = (wide_path(folder)?, descriptor.attributes());
            // SAFETY: both arguments outlive the call; the name ends with a zero.
            succeeded(unsafe { CreateDirectoryW(name.as_ptr(), &raw const attributes) })
        };
        match made {
            // By another program at the same moment.
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists && folder.is_dir() => {}
            result => result?,
        }
    }
    if path.is_dir() { Ok(()) } else { Err(io::ErrorKind::NotADirectory.into()) }
}

/// Opens a file for reading and writing; other programs may do the same, rename and delete it. A new file is private.
pub fn open_file(path: &Path, how: Open) -> io::Result<File> {
    let (name, descriptor) = (wide_path(path)?, Descriptor::private()?);
    let attributes = descriptor.attributes();
    let (disposition, flags) = match how {
        Open::New => (CREATE_NEW, FILE_ATTRIBUTE_NORMAL),
        Open::Any => (OPEN_ALWAYS, FILE_ATTRIBUTE_NORMAL),
        Open::Temporary => (CREATE_NEW, FILE_FLAG_DELETE_ON_CLOSE),
    };
    // SAFETY: the arguments outlive the call; the name ends with a zero. The handle belongs to nothing else.
    unsafe {
        let handle = CreateFileW(
            name.as_ptr(),
            GENERIC_READ | GENERIC_WRITE,
            FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE,
            &raw const attributes,
            disposition,
            flags,
            null_mut(),
        );
        if handle == INVALID_HANDLE_VALUE { Err(io::Error::last_os_error()) } else { Ok(File::from_raw_handle(handle)) }
    }
}

/// A security descriptor: this account, the owner and the system may do everything, and nothing is inherited. Folders
/// hand it down.
#[derive(Debug)]
pub struct Descriptor(PSECURITY_DESCRIPTOR);

impl Descriptor {
    /// Of a private file or folder.
    ///
    /// Errors: those of the system.
    pub fn private() -> io::Result<Self> {
        // The owner too: on a file server, this account's name is another one (S-1-3-4 is OWNER RIGHTS).
        let text = format!("D:P(A;OICI;FA;;;SY)(A;OICI;FA;;;S-1-3-4)(A;OICI;FA;;;{})", account()?);
        let mut descriptor = null_mut();
        // SAFETY: the text ends with a zero; the descriptor is freed when this value is dropped.
        succeeded(unsafe {
            ConvertStringSecurityDescriptorToSecurityDescriptorW(
                wide(text).as_ptr(),
                SDDL_REVISION_1,
                &raw mut descriptor,
                null_mut(),
            )
        })?;
        Ok(Self(descriptor))
    }

    /// For a call that makes something; valid as long as the descriptor.
    pub fn attributes(&self) -> SECURITY_ATTRIBUTES {
        SECURITY_ATTRIBUTES {
            nLength: size_of::<SECURITY_ATTRIBUTES>() as u32,
            lpSecurityDescriptor: self.0,
            bInheritHandle: 0,
        }
    }
}

impl Drop for Descriptor {
    fn drop(&mut self) {
        // SAFETY: allocated by the call that made it, freed once.
        unsafe { LocalFree(self.0) };
    }
}

/// The security identifier of the account this process runs under, as text (`S-1-5-21-…`).
fn account() -> io::Result<String> {
    // Room for the longest identifier, aligned as the structure at its front.
    let mut buffer = [0_u64; 32];
    let mut text = null_mut();
    // SAFETY: the token is closed by its owner; the buffer is as long as said, and the identifier in it is read before
    // it goes; the text ends with a zero and is freed after it was copied.
    unsafe {
        let mut token: HANDLE = null_mut();
        succeeded(OpenProcessToken(GetCurrentProcess(), TOKEN_QUERY, &raw mut token))?;
        let _token = OwnedHandle::from_raw_handle(token);
        let (mut length, room) = (0, size_of_val(&buffer) as u32);
        succeeded(GetTokenInformation(token, TokenUser, buffer.as_mut_ptr().cast(), room, &raw mut length))?;
        let user = &*buffer.as_ptr().cast::<TOKEN_USER>();
        succeeded(ConvertSidToStringSidW(user.User.Sid, &raw mut text))?;
        let length = (0..).take_while(|at| *text.add(*at) != 0).count();
        let sid = String::from_utf16_lossy(std::slice::from_raw_parts(text, length));
        LocalFree(text.cast());
        Ok(sid)
    }
}

/// Whether the access control list of a file or folder names only this account, the owner and the system.
#[cfg(test)]
pub fn is_private(path: &Path) -> io::Result<bool> {
    use windows_sys::Win32::Security::Authorization::{
        ConvertSecurityDescriptorToStringSecurityDescriptorW, GetNamedSecurityInfoW, SE_FILE_OBJECT,
    };
    use windows_sys::Win32::Security::DACL_SECURITY_INFORMATION;

    let name = wide_path(path)?;
    let (mut descriptor, mut text) = (null_mut(), null_mut());
    // SAFETY: the name ends with a zero; the descriptor and the text are freed after they were copied.
    let list = unsafe {
        let code = GetNamedSecurityInfoW(
            name.as_ptr(),
            SE_FILE_OBJECT,
            DACL_SECURITY_INFORMATION,
            null_mut(),
            null_mut(),
            null_mut(),
            null_mut(),
            &raw mut descriptor,
        );
        if code != 0 {
            return Err(io::Error::from_raw_os_error(code.cast_signed()));
        }
        succeeded(ConvertSecurityDescriptorToStringSecurityDescriptorW(
            descriptor,
            SDDL_REVISION_1,
            DACL_SECURITY_INFORMATION,
            &raw mut text,
            null_mut(),
        ))?;
        let length = (0..).take_while(|at| *text.add(*at) != 0).count();
        let list = String::from_utf16_lossy(std::slice::from_raw_parts(text, length));
        LocalFree(text.cast());
        LocalFree(descriptor);
        list
    };
    // Each entry is `(type;flags;rights;object;inherited object;account)`.
    let own = account()?;
    let mut accounts = list.split('(').skip(1).filter_map(|entry| entry.trim_end_matches(')').rsplit(';').next());
    Ok(list.contains('(') && accounts.all(|account| ["SY", "S-1-5-18", "OW", "S-1-3-4", &own].contains(&account)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_temporary_file_goes_with_its_handle() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("key");
        let file = open_file(&path, Open::Temporary).unwrap();
        assert!(std::fs::read(&path).is_ok(), "others can read it meanwhile");
        drop(file);
        assert!(!path.exists());
    }

    #[test]
    fn a_file_that_others_may_read_is_not_private() {
        // As Windows installs it, and as wine does.
        assert!(!is_private(Path::new(r"C:\windows")).unwrap());
        assert!(account().unwrap().starts_with("S-1-5-"));
    }
}
