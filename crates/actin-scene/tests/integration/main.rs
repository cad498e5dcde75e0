//! Reading of scenes through the public interface.

mod mistakes;
mod values;
