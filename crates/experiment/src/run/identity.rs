//! What the runs of a setup depend on.

use serde_json::{Value, json};

use super::Setup;

impl Setup {
    /// All that a run depends on beside planner, seed and program: the scenario's keys, and a checksum of the
    /// features and faces that came of them, as a mesh file may change while its name stays.
    #[must_use]
    pub fn identity(&self) -> Value {
        json!({ "keys": self.scenario.keys(), "object_crc32": self.object_checksum() })
    }

    /// The CRC-32 of the features at rest and of the faces between them, as text.
    #[must_use]
    pub fn object_checksum(&self) -> String {
        let mut hasher = crc32fast::Hasher::new();
        for coordinate in self.world.rest.iter().flat_map(|p| p.coords.iter()) {
            hasher.update(&coordinate.to_le_bytes());
        }
        for corner in self.planning.topology.faces().iter().flatten() {
            hasher.update(&(*corner as u64).to_le_bytes());
        }
        format!("{:08x}", hasher.finalize())
    }
}
