//! The texts of pages as SVG.

/// The contents of the text elements of an SVG, in order, without the elements in them.
pub fn texts(svg: &str) -> Vec<String> {
    let content = |element: &str| -> String {
        let content = element.split_once('>').unwrap().1.split("</text>").next().unwrap();
        content.split('<').map(|part| part.rsplit('>').next().unwrap()).collect()
    };
    svg.split("<text ").skip(1).map(content).collect()
}
