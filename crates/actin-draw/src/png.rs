//! PNG pictures from SVG.

use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::fontdb::Database;
use resvg::usvg::{Options, Tree};
use std::sync::{Arc, LazyLock};

/// The letters of all pictures, so that they are equal on all machines: Latin and Greek of `DejaVu` Sans.
const FONT: &[u8] = include_bytes!("../font/DejaVuSans.ttf");

static FONTS: LazyLock<Arc<Database>> = LazyLock::new(|| {
    let mut fonts = Database::new();
    fonts.load_font_data(FONT.to_vec());
    fonts.set_sans_serif_family("DejaVu Sans");
    Arc::new(fonts)
});

/// Converts an SVG picture to PNG with `scale` pixels per pixel of the SVG picture.
///
/// ```
/// let svg = "<svg xmlns='http://www.w3.org/2000/svg' width='30' height='20'><text y='18'>a</text></svg>";
/// let png = actin_draw::png(svg, 2.0)?;
/// // Width and height are at bytes 16 and 20.
/// assert_eq!((png[19], png[23]), (60, 40));
/// # Ok::<(), String>(())
/// ```
///
/// # Errors
/// If the text is not an SVG picture, or its size is not positive.
pub fn png(svg: &str, scale: f32) -> Result<Vec<u8>, String> {
    let options = Options {
        fontdb: FONTS.clone(),
        font_family: "DejaVu Sans".into(),
        ..Options::default()
    };
    let tree = Tree::from_str(svg, &options).map_err(|error| error.to_string())?;
    let size = tree.size().to_int_size().scale_by(scale);
    let size = size.ok_or("the size of the picture is not positive")?;
    let mut pixels = Pixmap::new(size.width(), size.height()).ok_or("the picture is too large")?;
    resvg::render(
        &tree,
        Transform::from_scale(scale, scale),
        &mut pixels.as_mut(),
    );
    pixels.encode_png().map_err(|error| error.to_string())
}
