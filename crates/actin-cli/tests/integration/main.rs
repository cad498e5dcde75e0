//! The `actin` program.

mod book;
mod common;
mod endings;
mod export;
mod files;
mod follow;
mod mistakes;
mod overrides;
mod program;
mod resume;
mod snakemake;
mod studies;
mod sweep;
mod traced;
mod trade;
mod view;
