//! Chooses between Wayland and X11, and takes source locations out of error messages.

/// Takes `file.rs:123:` out of a message: the folders of the machine the program was built on say nothing to a user.
pub fn without_source_locations(text: &str) -> String {
    let words = text.split(' ').filter(|word| !is_source_location(word));
    words.collect::<Vec<_>>().join(" ").replace("os error at ", "")
}

/// `…/event_loop.rs:763:` or `…/event_loop.rs:763:5`.
fn is_source_location(word: &str) -> bool {
    let mut parts = word.trim_end_matches([':', ',', ')']).split(".rs:");
    let (Some(_), Some(numbers), None) = (parts.next(), parts.next(), parts.next()) else { return false };
    !numbers.is_empty() && numbers.chars().all(|c| c.is_ascii_digit() || c == ':')
}

#[cfg(all(unix, not(target_os = "macos")))]
mod unix {
    use std::ffi::{CStr, OsString};
    use std::os::unix::net::UnixStream;
    use std::path::PathBuf;

    /// Whether windows are drawn by a Wayland compositor, which lets no program bring its window to the front.
    pub fn is_wayland() -> bool {
        let is_set = |name| std::env::var_os(name).is_some_and(|value| !value.is_empty());
        (is_set("WAYLAND_DISPLAY") || is_set("WAYLAND_SOCKET")) && !prefers_x11()
    }

    /// Whether there is an X11 display or a Wayland compositor to draw a window on, as far as variables tell.
    pub fn is_there() -> bool {
        is_wayland() || std::env::var_os("DISPLAY").is_some_and(|value| !value.is_empty())
    }

    /// Whether to use X11 although `WAYLAND_DISPLAY` is set: X11 is there, and no compositor answers at the
    /// Wayland socket.
    /// Such a variable is left over in sessions that were started from another one (`su`, `tmux`, remote desktops).
    pub fn prefers_x11() -> bool {
        prefers_x11_in(|name| std::env::var_os(name))
    }

    /// The first library that the keyboard needs on this display and that is not installed. winit panics without it,
    /// where it says of every other library that is missing.
    pub fn missing_library() -> Option<MissingLibrary> {
        let needed: &[MissingLibrary] = if is_wayland() { &[XKBCOMMON] } else { &[XKBCOMMON, XKBCOMMON_X11] };
        needed.iter().find(|library| !can_be_loaded(library.file)).copied()
    }

    /// A shared library that is looked for when the window opens.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub struct MissingLibrary {
        file: &'static CStr,
        /// The package of Debian and Ubuntu that has it.
        package: &'static str,
    }

    impl std::fmt::Display for MissingLibrary {
        fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
            write!(f, "{} is not installed (Debian, Ubuntu: package {})", self.file.to_string_lossy(), self.package)
        }
    }

    const XKBCOMMON: MissingLibrary = MissingLibrary { file: c"libxkbcommon.so.0", package: "libxkbcommon0" };
    const XKBCOMMON_X11: MissingLibrary =
        MissingLibrary { file: c"libxkbcommon-x11.so.0", package: "libxkbcommon-x11-0" };

    /// The library stays loaded: winit asks for it next.
    fn can_be_loaded(file: &CStr) -> bool {
        // SAFETY: the name ends with a zero byte; the initialisers of these libraries have no preconditions.
        !unsafe { libc::dlopen(file.as_ptr(), libc::RTLD_LAZY) }.is_null()
    }

    fn prefers_x11_in(variable: impl Fn(&str) -> Option<OsString>) -> bool {
        let set = |name| variable(name).filter(|value| !value.is_empty());
        // An inherited socket is open already.
        let (Some(wayland), Some(_), None) = (set("WAYLAND_DISPLAY"), set("DISPLAY"), set("WAYLAND_SOCKET")) else {
            return false;
        };
        // An absolute path, or a name in the runtime folder (wl_display_connect(3)).
        let path = set("XDG_RUNTIME_DIR").map(PathBuf::from).unwrap_or_default().join(wayland);
        !path.is_absolute() || UnixStream::connect(path).is_err()
    }

    #[cfg(test)]
    mod tests {
        use std::os::unix::net::UnixListener;

        use super::*;

        #[test]
        fn a_library_that_is_missing_is_named_with_its_package() {
            assert!(can_be_loaded(c"libc.so.6") && !can_be_loaded(c"libnone-of-that-name.so.0"));
            let said = "libxkbcommon-x11.so.0 is not installed (Debian, Ubuntu: package libxkbcommon-x11-0)";
            assert_eq!(XKBCOMMON_X11.to_string(), said);
        }

        #[test]
        fn x11_is_used_only_if_wayland_does_not_answer() {
            let folder = tempfile::tempdir().unwrap();
            let runtime = folder.path().to_str().unwrap();
            let alive = folder.path().join("wayland-1");
            let _compositor = UnixListener::bind(&alive).unwrap();
            // A compositor that was killed leaves its socket.
            drop(UnixListener::bind(folder.path().join("wayland-0")).unwrap());
            let prefers = |variables: &[(&str, &str)]| {
                let value = |name: &str| variables.iter().find(|(n, _)| *n == name).map(|(_, value)| value.into());
                prefers_x11_in(value)
            };
            let (x11, at) = (("DISPLAY", ":0"), ("XDG_RUNTIME_DIR", runtime));
            for stale in ["wayland-0", "wayland-9", "/nowhere/wayland-1"] {
                assert!(prefers(&[("WAYLAND_DISPLAY", stale), at, x11]), "{stale}");
            }
            assert!(prefers(&[("WAYLAND_DISPLAY", "wayland-1"), x11]), "no runtime folder");
            assert!(!prefers(&[("WAYLAND_DISPLAY", "wayland-1"), at, x11]));
            assert!(!prefers(&[("WAYLAND_DISPLAY", alive.to_str().unwrap()), x11]));
            assert!(!prefers(&[("WAYLAND_DISPLAY", "wayland-0"), at]), "there is no X11");
            assert!(!prefers(&[("WAYLAND_DISPLAY", "wayland-0"), at, x11, ("WAYLAND_SOCKET", "5")]));
            assert!(!prefers(&[x11]) && !prefers(&[("WAYLAND_DISPLAY", ""), at, x11]));
        }
    }
}

#[cfg(all(unix, not(target_os = "macos")))]
pub use unix::{MissingLibrary, is_there, is_wayland, missing_library, prefers_x11};

/// Whether windows are drawn by a Wayland compositor; never here.
#[cfg(not(all(unix, not(target_os = "macos"))))]
pub fn is_wayland() -> bool {
    false
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_build_machine_is_not_named() {
        let text = "winit EventLoopError: os error at /home/b/registry/src/winit-0.30.13/src/mod.rs:763: \
                    neither WAYLAND_DISPLAY nor DISPLAY is set.";
        let clean = "winit EventLoopError: neither WAYLAND_DISPLAY nor DISPLAY is set.";
        assert_eq!(without_source_locations(text), clean);
        assert_eq!(without_source_locations("at C:\\b\\x.rs:1:2, failed"), "at failed");
        for same in ["OpenGL 2.1 is missing", "a:b.rs", "x.rs:", "see x.rs:y: no"] {
            assert_eq!(without_source_locations(same), same);
        }
    }
}
