//! The tables of a page.

use super::escaped;

/// Tables as HTML, one after the other.
#[derive(Default)]
pub struct Tables(String);

impl Tables {
    /// The tables so far.
    pub(super) fn html(&self) -> &str {
        &self.0
    }

    /// Adds a table of names and values.
    pub fn add<N: AsRef<str>>(&mut self, title: &str, rows: &[(N, String)]) {
        self.open(title, "");
        for (name, value) in rows {
            let (name, value) = (escaped(name.as_ref()), escaped(value));
            self.put(&format!("<tr><td>{name}</td><td>{value}</td></tr>\n"));
        }
        self.close();
    }

    /// Adds a table of names and values with a bar for each value; the largest has the longest.
    pub fn add_bars(&mut self, title: &str, rows: &[(String, f64, String)]) {
        self.open(title, "");
        let most = rows
            .iter()
            .map(|row| row.1)
            .fold(f64::MIN_POSITIVE, f64::max);
        for (name, value, text) in rows {
            let (name, text) = (escaped(name), escaped(text));
            let width = 100.0 * value.max(0.0) / most;
            self.put(&format!(
                "<tr><td>{name}</td><td>{text}</td><td class=\"meter\"><i style=\"width:{width:.1}%\"></i></td></tr>\n"
            ));
        }
        self.close();
    }

    /// Adds a table over the full width with a head.
    pub fn add_wide(&mut self, title: &str, head: &[&str], rows: &[Vec<String>]) {
        self.open(title, " wide");
        let cells = |tag: &str, texts: &mut dyn Iterator<Item = &str>| {
            let cells = texts.map(|text| format!("<{tag}>{}</{tag}>", escaped(text)));
            format!("<tr>{}</tr>\n", cells.collect::<String>())
        };
        self.put(&cells("th", &mut head.iter().copied()));
        for row in rows {
            self.put(&cells("td", &mut row.iter().map(String::as_str)));
        }
        self.close();
    }

    fn open(&mut self, title: &str, class: &str) {
        let title = escaped(title);
        self.put(&format!(
            "<div class=\"card{class}\"><h2>{title}</h2><table>\n"
        ));
    }

    fn close(&mut self) {
        self.put("</table></div>\n");
    }

    fn put(&mut self, text: &str) {
        self.0.push_str(text);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_are_escaped_and_the_largest_bar_is_full() {
        let mut tables = Tables::default();
        tables.add("A & B", &[("<x>", "1 < 2".into())]);
        let rows = [
            ("a".into(), 1.0, "1 s".into()),
            ("b".into(), 4.0, "4 s".into()),
        ];
        tables.add_bars("Times", &rows);
        let html = tables.html();
        assert!(html.contains("<h2>A &amp; B</h2>"), "{html}");
        assert!(
            html.contains("<td>&lt;x&gt;</td><td>1 &lt; 2</td>"),
            "{html}"
        );
        assert!(html.contains("width:25.0%") && html.contains("width:100.0%"));
    }
}
