//! Files of results: whole or not at all.

mod atomic;
mod folder_lock;
mod temporary;

pub use atomic::{AtomicFile, checksum};
pub use folder_lock::FolderLock;
pub use temporary::{make_folder, not_writable, prepare_folder};
