//! Parsed expressions against expression trees that are evaluated independently.

use coupler_curves::expression::{Caption, Dimension, Error, Expression, Quantity, Scope};
use coupler_curves::geometry::trig;
use proptest::prelude::*;

/// An expression as a tree, whose numbers are not negative.
#[derive(Clone, Debug)]
enum Tree {
    Number(f64),
    Name(usize),
    Minus(Box<Tree>),
    Not(Box<Tree>),
    Binary(&'static str, Box<Tree>, Box<Tree>),
    Call(&'static str, Vec<Tree>),
}

/// The names that expressions use, with their values; the last has none. None is in degrees, which do not go everywhere.
const NAMES: [(&str, f64); 4] = [("p", 2.0), ("mu_min", -0.75), ("_k1", 1e-3), ("missing", f64::NAN)];

const ARITHMETIC: [&str; 5] = ["+", "-", "*", "/", "^"];
const COMPARISONS: [&str; 6] = ["==", "!=", "<", "<=", ">", ">="];

/// The precedence of an expression, from the table of the language; numbers, names and calls bind tightest.
fn precedence(tree: &Tree) -> u8 {
    match tree {
        Tree::Binary("or", ..) => 1,
        Tree::Binary("and", ..) => 2,
        Tree::Not(_) => 3,
        Tree::Binary(sign, ..) if COMPARISONS.contains(sign) => 4,
        Tree::Binary("+" | "-", ..) => 5,
        Tree::Binary("*" | "/", ..) => 6,
        Tree::Minus(_) => 7,
        Tree::Binary(..) => 8,
        _ => 9,
    }
}

/// The text of a tree, with only the necessary parentheses or with all of them.
fn tree_text(tree: &Tree, has_all_parentheses: bool) -> String {
    let part = |tree: &Tree, least: u8| {
        let text = tree_text(tree, has_all_parentheses);
        if has_all_parentheses || precedence(tree) < least { format!("({text})") } else { text }
    };
    match tree {
        Tree::Number(value) => format!("{value:?}"),
        Tree::Name(k) => NAMES[*k].0.to_owned(),
        Tree::Minus(inner) => format!("-{}", part(inner, 7)),
        Tree::Not(inner) => format!("not {}", part(inner, 3)),
        // It associates to the right, and the exponent may have a sign.
        Tree::Binary("^", a, b) => format!("{}^{}", part(a, 9), part(b, 7)),
        Tree::Binary(sign, a, b) => format!("{} {sign} {}", part(a, precedence(tree)), part(b, precedence(tree) + 1)),
        Tree::Call(name, arguments) => {
            format!("{name}({})", arguments.iter().map(|a| part(a, 0)).collect::<Vec<_>>().join(", "))
        }
    }
}

fn bool_value(is_true: bool) -> f64 {
    f64::from(u8::from(is_true))
}

fn value(tree: &Tree) -> f64 {
    match tree {
        Tree::Number(value) => *value,
        Tree::Name(k) => NAMES[*k].1,
        Tree::Minus(inner) => -value(inner),
        Tree::Not(inner) => bool_value(value(inner) != 1.0),
        Tree::Binary(sign, a, b) => {
            let (a, b) = (value(a), value(b));
            match *sign {
                "+" => a + b,
                "-" => a - b,
                "*" => a * b,
                "/" => a / b,
                "^" => trig::pow(a, b),
                "==" => bool_value(a == b),
                "!=" => bool_value(a.partial_cmp(&b).is_some_and(std::cmp::Ordering::is_ne)),
                "<" => bool_value(a < b),
                "<=" => bool_value(a <= b),
                ">" => bool_value(a > b),
                ">=" => bool_value(a >= b),
                "and" => a * b,
                _ => bool_value(a + b > 0.0),
            }
        }
        Tree::Call(name, arguments) => {
            let values: Vec<f64> = arguments.iter().map(value).collect();
            let missing = values.iter().any(|value| value.is_nan());
            match (*name, &values[..]) {
                (_, _) if missing => f64::NAN,
                ("min", _) => values.iter().copied().reduce(f64::min).unwrap(),
                ("max", _) => values.iter().copied().reduce(f64::max).unwrap(),
                ("sqrt", [x]) => x.sqrt(),
                ("abs", [x]) => x.abs(),
                ("sin", [x]) => trig::sin(*x),
                ("atan2", [y, x]) => trig::atan2(*y, *x),
                _ => unreachable!("{name}"),
            }
        }
    }
}

fn number() -> impl Strategy<Value = Tree> {
    let leaf = prop_oneof![
        (0..20u8).prop_map(|n| Tree::Number(f64::from(n))),
        // Written in the shortest form, with an exponent where that is shorter.
        (proptest::num::f64::NORMAL | proptest::num::f64::SUBNORMAL | proptest::num::f64::ZERO)
            .prop_map(|x: f64| Tree::Number(x.abs())),
        (0..NAMES.len()).prop_map(Tree::Name),
    ];
    leaf.prop_recursive(5, 40, 3, |inner| {
        let two = (proptest::sample::select(&ARITHMETIC[..]), inner.clone(), inner.clone());
        prop_oneof![
            1 => inner.clone().prop_map(|a| Tree::Minus(Box::new(a))),
            4 => two.prop_map(|(sign, a, b)| Tree::Binary(sign, Box::new(a), Box::new(b))),
            1 => (proptest::sample::select(&["sqrt", "abs", "sin"][..]), inner.clone())
                .prop_map(|(name, a)| Tree::Call(name, vec![a])),
            1 => (inner.clone(), inner.clone()).prop_map(|(y, x)| Tree::Call("atan2", vec![y, x])),
            1 => (proptest::sample::select(&["min", "max"][..]), proptest::collection::vec(inner, 1..4))
                .prop_map(|(name, arguments)| Tree::Call(name, arguments)),
        ]
    })
}

fn condition() -> impl Strategy<Value = Tree> {
    let leaf = (proptest::sample::select(&COMPARISONS[..]), number(), number())
        .prop_map(|(sign, a, b)| Tree::Binary(sign, Box::new(a), Box::new(b)));
    leaf.prop_recursive(4, 12, 2, |inner| {
        prop_oneof![
            1 => inner.clone().prop_map(|a| Tree::Not(Box::new(a))),
            3 => (proptest::sample::select(&["and", "or"][..]), inner.clone(), inner)
                .prop_map(|(sign, a, b)| Tree::Binary(sign, Box::new(a), Box::new(b))),
        ]
    })
}

/// Asserts that the parsed text of a tree has the value of the tree.
fn assert_same_value(tree: &Tree) {
    let expected = value(tree);
    for has_all_parentheses in [false, true] {
        let text = tree_text(tree, has_all_parentheses);
        let parsed = Expression::parse(&text).unwrap_or_else(|error| panic!("{text}: {error}"));
        let load = |k: usize| NAMES.iter().find(|(name, _)| *name == parsed.names()[k]).unwrap().1;
        let found = parsed.evaluate(load);
        assert!(found == expected || found.is_nan() && expected.is_nan(), "{text}: {found}, not {expected}");
        // White space does not matter.
        let spaced = format!(" \t{}\n", text.replace('(', " ( ").replace(',', " , ").replace(" - ", "-"));
        let again = Expression::parse(&spaced).unwrap().evaluate(load);
        assert!(again == found || again.is_nan() && found.is_nan(), "{spaced}");
    }
}

/// Asserts that an error has a span of whole characters of the text, and help.
fn assert_error_is_placed<T>(result: Result<T, Error>, text: &str) {
    if let Err(Error { message, span, help, .. }) = result {
        assert!(text.get(span.clone()).is_some(), "{message} at {span:?} of {text:?}");
        assert!(!message.is_empty() && !help.is_empty(), "{message}");
    }
}

/// Texts that are nearly expressions, with characters of several bytes.
const NEARLY: &str =
    "( |\\)|[-+*/^,=<>!&{}:.]|and |or|not |sqrt\\(|min\\(|p|_|1e|[0-9]{1,3}|°|−|é|\u{1F980}|deg|\u{0}){0,30}";

proptest! {
    #![proptest_config(crate::random())]

    #[test]
    fn numbers_have_the_value_of_their_tree(tree in number()) {
        assert_same_value(&tree);
    }

    #[test]
    fn conditions_have_the_value_of_their_tree(tree in condition()) {
        assert_same_value(&tree);
    }

    #[test]
    fn no_text_makes_the_parser_panic(any: String, nearly in NEARLY) {
        for text in [any, nearly] {
            assert_error_is_placed(Expression::parse(&text), &text);
            assert_error_is_placed(Expression::parse(&text).and_then(|parsed| parsed.check(&Scope::from_numbers(["p"]))), &text);
            assert_error_is_placed(Caption::parse(&text), &text);
            assert_error_is_placed(Quantity::parse(&text, Dimension::Angle), &text);
            assert_error_is_placed(Quantity::parse(&text, Dimension::PaperLength), &text);
            if let Ok(parsed) = Expression::parse(&text) {
                parsed.evaluate(|_| 1.5);
            }
        }
    }
}
