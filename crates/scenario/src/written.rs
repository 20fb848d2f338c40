//! A scenario as a file that gives it back.

use std::path::absolute;

use adslam_diagnostics::InputError;

use super::{Object, Scenario};

const HEAD: &str = "\
# The scenario of the run beside it, as it was run: every key with the value that held, be it from the scenario's
# file, an override, the command line or a default. Run again it gives the same results.

";

impl Scenario {
    /// The scenario as TOML, with every key that has a value. Read again, wherever it lies, it is the same: the path
    /// of a mesh is absolute in it.
    ///
    /// # Errors
    /// A mesh whose path is no Unicode text, which TOML cannot hold.
    pub fn to_toml(&self) -> Result<String, InputError> {
        let mut scenario = self.clone();
        if let Object::Mesh(mesh) = &mut scenario.object {
            mesh.file =
                absolute(&mesh.file).map_err(|cause| InputError::unreadable(&mesh.file, cause))?;
            if mesh.file.to_str().is_none() {
                let message = format!("{} is no Unicode text", mesh.file.display());
                return Err(InputError::about_file(&mesh.file, message)
                    .with_help("give the mesh and its folders plain names"));
            }
        }
        match toml::to_string(&scenario) {
            Ok(keys) => Ok(format!("{HEAD}{keys}")),
            Err(cause) => {
                let message = format!("the scenario cannot be written as TOML: {cause}");
                Err(InputError::about_file(self.path(), message))
            }
        }
    }
}
