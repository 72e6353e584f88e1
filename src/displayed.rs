//! Types serialized by their display form.

/// Implements `Serialize` of a type by its `Display`, with the feature `serde`.
macro_rules! serialize_as_displayed {
    ($type:ty) => {
        #[cfg(feature = "serde")]
        impl serde::Serialize for $type {
            fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                serializer.collect_str(self)
            }
        }
    };
}

pub(crate) use serialize_as_displayed;
