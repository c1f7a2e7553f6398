/// A type that travels and is stored as the text a person writes: `#[serde(try_from = "String", into = "String")]` by
/// way of its `FromStr` and `Display`.
macro_rules! text_in_messages {
    ($type:ty, $error:ty) => {
        impl TryFrom<String> for $type {
            type Error = $error;
            fn try_from(text: String) -> Result<Self, $error> {
                text.parse()
            }
        }

        impl From<$type> for String {
            fn from(value: $type) -> Self {
                value.to_string()
            }
        }
    };
}
