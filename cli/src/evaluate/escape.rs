//! Text that means itself in HTML and SVG.

/// The text with `&`, `<`, `>` and `"` written as character references.
pub fn escape(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
}
