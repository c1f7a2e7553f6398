//! The bundled mock controller.

pub mod opcua;
