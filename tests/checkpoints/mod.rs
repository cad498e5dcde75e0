//! Runs that are left and taken up again through their files, and files that are damaged.

mod common;
mod cost;
mod damaged;
mod disk;
mod observed;
mod resumed;
