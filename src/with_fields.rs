//! Methods that replace one field each, the constructors of non-exhaustive structs.

/// `with_fields!(Type { with_field field: Type of the field, ... })`; a lifetime precedes the type.
macro_rules! with_fields {
    (<$life:lifetime> $type:ty { $($method:ident $field:ident: $value:ty),* $(,)? }) => {
        impl<$life> $type {
            $(with_fields!(@ $method $field: $value);)*
        }
    };
    ($type:ty { $($method:ident $field:ident: $value:ty),* $(,)? }) => {
        impl $type {
            $(with_fields!(@ $method $field: $value);)*
        }
    };
    (@ $method:ident $field:ident: $value:ty) => {
        #[doc = concat!("Replaces the field [`", stringify!($field), "`](Self#structfield.", stringify!($field), ").")]
        #[must_use]
        pub fn $method(mut self, $field: $value) -> Self {
            self.$field = $field;
            self
        }
    };
}

pub(crate) use with_fields;
