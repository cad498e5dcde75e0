//! Instruction set of the vector code.

use pulp::Arch;
use std::sync::OnceLock;

/// Environment variable that sets the instruction set: `scalar`, `avx2` or `avx512`.
pub(crate) const INSTRUCTIONS: &str = "ACTIN_SIMD";

/// Instruction set of all vector code in this process: the best one of the processor, or the one
/// named by the environment variable `ACTIN_SIMD`. Other libraries, such as faer, ignore the
/// variable.
///
/// # Panics
/// If `ACTIN_SIMD` is invalid; see [`chosen_arch`].
#[inline]
pub fn arch() -> Arch {
    static ARCH: OnceLock<Arch> = OnceLock::new();
    *ARCH.get_or_init(|| chosen_arch().unwrap_or_else(|error| panic!("{error}")))
}

/// Instruction set named by `ACTIN_SIMD`, or the best one of the processor if the variable is not
/// set.
///
/// # Errors
/// If the name is unknown, or if the processor lacks the instruction set.
pub fn chosen_arch() -> Result<Arch, String> {
    match std::env::var(INSTRUCTIONS) {
        Err(std::env::VarError::NotPresent) => Ok(Arch::new()),
        Ok(name) => named(&name),
        Err(error) => Err(format!("{INSTRUCTIONS}: {error}")),
    }
}

fn named(name: &str) -> Result<Arch, String> {
    let arch = match name {
        "scalar" => Some(Arch::Scalar),
        #[cfg(target_arch = "x86_64")]
        "avx2" => pulp::x86::V3::try_new().map(Arch::V3),
        #[cfg(target_arch = "x86_64")]
        "avx512" => pulp::x86::V4::try_new().map(Arch::V4),
        #[cfg(not(target_arch = "x86_64"))]
        "avx2" | "avx512" => None,
        _ => {
            return Err(format!(
                "{INSTRUCTIONS} = \"{name}\": must be one of scalar, avx2, avx512"
            ));
        }
    };
    arch.ok_or_else(|| format!("{INSTRUCTIONS} = \"{name}\": this processor does not have it"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn instruction_sets_have_names() {
        assert!(matches!(named("scalar"), Ok(Arch::Scalar)));
        let best = format!("{:?}", Arch::new());
        for (name, sets) in [("avx2", "V"), ("avx512", "V4")] {
            assert_eq!(
                named(name).is_ok(),
                best.starts_with(sets),
                "{name}: {best}"
            );
        }
        let error = named("AVX2").unwrap_err();
        assert!(error.contains("scalar, avx2, avx512"), "{error}");
    }
}
