//! The font of all figures, the same on every machine.

use std::sync::Arc;

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use resvg::usvg::fontdb::Database;

/// Noto Sans, the characters that figures need; font/README.md says how it was made.
static NOTO_SANS: &[u8] = include_bytes!("../font/NotoSans-Regular-subset.ttf");

/// What it is called in a figure, and what to take where the embedded font is ignored.
pub(crate) const FAMILIES: &str = "Noto Sans, Arial, Helvetica, sans-serif";

/// The style sheet that brings the font into an SVG file.
pub(crate) fn style_sheet() -> String {
    let data = BASE64_STANDARD.encode(NOTO_SANS);
    format!("@font-face{{font-family:\"Noto Sans\";src:url(data:font/ttf;base64,{data})}}")
}

/// The font for turning SVG into pixels, and no other.
pub(crate) fn database() -> Arc<Database> {
    let mut fonts = Database::new();
    fonts.load_font_data(NOTO_SANS.to_vec());
    fonts.set_sans_serif_family("Noto Sans");
    Arc::new(fonts)
}
