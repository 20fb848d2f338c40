//! How the object of a setup is distinguished from others.

use super::Setup;

impl Setup {
    /// The CRC-32 of the features at rest and of the faces between them, as text: a mesh file
    /// may change while its name stays.
    #[must_use]
    pub fn object_checksum(&self) -> String {
        let mut hasher = crc32fast::Hasher::new();
        for coordinate in self.model.world.rest.iter().flat_map(|p| p.coords.iter()) {
            hasher.update(&coordinate.to_le_bytes());
        }
        for corner in self.model.planning.topology.faces().iter().flatten() {
            hasher.update(&(*corner as u64).to_le_bytes());
        }
        format!("{:08x}", hasher.finalize())
    }
}
