//! How packets are described: little endian, packed, one table row a field.
//!
//! [`packet!`] makes from one table the zero-copy view (one accessor a field), the owned struct with `encode`, and
//! `FIELDS`, from which errors take the name of a field. An offset stands in the source once.

/// One row of a packet's table.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Field {
    /// The name in the manual.
    pub name: &'static str,
    /// From the start of the packet, in bytes.
    pub offset: usize,
    /// In bytes.
    pub size: usize,
}

/// A value with a fixed number of bytes in a packet.
pub trait Wire: Copy {
    /// In bytes.
    const SIZE: usize;

    /// Reads the value that begins at `at`.
    ///
    /// # Panics
    /// If the value does not fit into `bytes` from `at` on.
    fn read(bytes: &[u8], at: usize) -> Self;

    /// Writes the value to `at`.
    ///
    /// # Panics
    /// If the value does not fit into `bytes` from `at` on.
    fn write(self, bytes: &mut [u8], at: usize);
}

macro_rules! wire_number {
    ($($number:ty),*) => {$(
        impl Wire for $number {
            const SIZE: usize = size_of::<$number>();

            #[inline(always)]
            fn read(bytes: &[u8], at: usize) -> Self {
                let mut value = [0; size_of::<$number>()];
                value.copy_from_slice(&bytes[at..at + size_of::<$number>()]);
                <$number>::from_le_bytes(value)
            }

            #[inline(always)]
            fn write(self, bytes: &mut [u8], at: usize) {
                bytes[at..at + size_of::<$number>()].copy_from_slice(&self.to_le_bytes());
            }
        }
    )*};
}

wire_number!(u8, i8, u16, i16, u32, u64, i64, f32, f64);

impl<T: Wire, const N: usize> Wire for [T; N] {
    const SIZE: usize = T::SIZE * N;

    #[inline(always)]
    fn read(bytes: &[u8], at: usize) -> Self {
        std::array::from_fn(|index| T::read(bytes, at + index * T::SIZE))
    }

    #[inline(always)]
    fn write(self, bytes: &mut [u8], at: usize) {
        for (index, value) in self.into_iter().enumerate() {
            value.write(bytes, at + index * T::SIZE);
        }
    }
}

/// Declares a packet: `View / Owned [size] { offset "name in the manual" field: type, … }`. Bytes between the rows are
/// reserved; they are not read, and `encode` leaves them 0. `tag` is the first byte of force sensor packets.
macro_rules! packet {
    (
        $(#[$doc:meta])*
        $view:ident / $owned:ident [$size:literal] $(tag $tag:literal)? {
            $( $(#[$field_doc:meta])* $offset:literal $name:literal $field:ident: $type:ty, )*
        }
    ) => {
        $(#[$doc])*
        ///
        /// The bytes of a packet; an accessor reads its field where it lies.
        #[derive(Debug, Clone, Copy)]
        pub struct $view<'a>(&'a [u8; $size]);

        impl<'a> $view<'a> {
            /// In bytes.
            pub const SIZE: usize = $size;
            /// The rows of the manual's table, without those that are reserved.
            pub const FIELDS: &'static [$crate::records::layout::Field] = &[
                $($crate::records::layout::Field {
                    name: $name,
                    offset: $offset,
                    size: <$type as $crate::records::layout::Wire>::SIZE,
                },)*
            ];

            /// Looks at the bytes of a packet. Checks nothing.
            #[inline(always)]
            pub const fn new(bytes: &'a [u8; $size]) -> Self {
                Self(bytes)
            }

            /// The bytes of the packet.
            pub const fn bytes(self) -> &'a [u8; $size] {
                self.0
            }

            $(
                $(#[$field_doc])*
                #[doc = concat!("Field `", $name, "` at byte ", $offset, ".")]
                #[inline(always)]
                pub fn $field(self) -> $type {
                    <$type as $crate::records::layout::Wire>::read(self.0, $offset)
                }
            )*

            /// Reads every field.
            #[inline(always)]
            pub fn to_packet(self) -> $owned {
                $owned { $($field: self.$field(),)* }
            }
        }

        $(#[$doc])*
        ///
        /// The fields of a packet.
        #[derive(Debug, Clone, Copy, PartialEq, Default)]
        pub struct $owned {
            $(
                $(#[$field_doc])*
                #[doc = concat!("Field `", $name, "` at byte ", $offset, ".")]
                pub $field: $type,
            )*
        }

        impl $owned {
            /// The bytes of the packet. Reserved bytes are 0.
            pub fn encode(&self) -> [u8; $size] {
                let mut bytes = [0; $size];
                $($crate::records::layout::Wire::write(self.$field, &mut bytes, $offset);)*
                $(bytes[0] = $tag;)?
                bytes
            }
        }

        // Inside a table of another packet, this one is a field.
        impl $crate::records::layout::Wire for $owned {
            const SIZE: usize = $size;

            #[inline(always)]
            fn read(bytes: &[u8], at: usize) -> Self {
                match bytes[at..].first_chunk() {
                    Some(packet) => $view::new(packet).to_packet(),
                    None => panic!("{} bytes do not fit behind byte {at}", $size),
                }
            }

            #[inline(always)]
            fn write(self, bytes: &mut [u8], at: usize) {
                bytes[at..at + $size].copy_from_slice(&self.encode());
            }
        }
    };
}

pub(crate) use packet;

/// The field that holds the byte at `offset`; bytes between two fields are reserved.
pub(crate) fn field_at(fields: &[Field], offset: usize) -> Field {
    let reserved = Field { name: "reserved", offset, size: 1 };
    fields.iter().find(|field| (field.offset..field.offset + field.size).contains(&offset)).copied().unwrap_or(reserved)
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    /// Fields follow each other, do not overlap, and do not reach over the packet's end.
    pub fn assert_table(fields: &[Field], size: usize) {
        let mut end = 0;
        for field in fields {
            assert!(field.offset >= end, "{} begins at {} before {end}", field.name, field.offset);
            end = field.offset + field.size;
        }
        assert!(end <= size, "the last field ends at {end} behind {size}");
    }

    #[test]
    fn a_byte_belongs_to_the_field_that_holds_it() {
        let fields = [Field { name: "a", offset: 1, size: 2 }, Field { name: "b", offset: 4, size: 1 }];
        let names = [0, 1, 2, 3, 4, 5].map(|offset| field_at(&fields, offset).name);
        assert_eq!(names, ["reserved", "a", "a", "reserved", "b", "reserved"]);
    }
}
