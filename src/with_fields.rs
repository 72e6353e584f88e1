//! Methods that replace one field each: how structs are filled in that may get more fields.

/// `with_fields!(Type { with_field field: Type of the field, ... })`; a lifetime goes in front of the type.
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
        #[doc = concat!("The same with another [`", stringify!($field), "`](Self#structfield.", stringify!($field), ").")]
        #[must_use]
        pub fn $method(mut self, $field: $value) -> Self {
            self.$field = $field;
            self
        }
    };
}

pub(crate) use with_fields;
