/// The text of a controller: UTF-8 where the bytes are UTF-8, Shift-JIS where they are Shift-JIS (what controllers send
/// that were set up on a Japanese Windows), otherwise UTF-8 with `�` for what is neither.
pub fn controller_text(bytes: &[u8]) -> String {
    if let Ok(text) = std::str::from_utf8(bytes) {
        return text.to_owned();
    }
    match encoding_rs::SHIFT_JIS.decode_without_bom_handling(bytes) {
        (text, false) => text.into_owned(),
        (_, true) => String::from_utf8_lossy(bytes).into_owned(),
    }
}
