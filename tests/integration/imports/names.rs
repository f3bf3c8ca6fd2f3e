//! The names of a crate's modules, and the files that define them.

use std::collections::{BTreeMap, BTreeSet};

use syn::buffer::{Cursor, TokenBuffer};
use syn::visit::{self, Visit};
use syn::{Attribute, Item, ItemUse, Macro, Meta, MetaList, UseTree, Visibility};

use super::Imports;

/// What a name stands for.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Meaning {
    /// A module, by its number.
    Module(usize),
    /// Anything else, by the number of the file that defines it.
    Item(usize),
}

/// What `use` brings into a module: a name, or `None` for all names of what the path leads to.
struct Use {
    name: Option<String>,
    path: Vec<String>,
    is_exported: bool,
}

/// A module, of a file or within one.
struct Module {
    file: usize,
    parent: Option<usize>,
    defined: BTreeMap<String, BTreeSet<Meaning>>,
    /// The words in calls of macros that define items, each of which may be the name of one.
    in_macros: BTreeSet<String>,
    uses: Vec<Use>,
    code: Vec<Item>,
}

/// The names of all modules of a crate. Methods and macros are not among them.
#[derive(Default)]
pub(super) struct Names {
    files: Vec<String>,
    modules: Vec<Module>,
}

impl Names {
    /// The names in the files of a crate, of which one is `lib.rs`.
    pub(super) fn of(texts: &BTreeMap<String, String>) -> Names {
        let mut names = Names::default();
        names.read_file(texts, "lib.rs", None);
        names
    }

    /// Whether the module of a file has been declared.
    pub(super) fn has_read(&self, file: &str) -> bool {
        self.files.iter().any(|read| read == file)
    }

    fn read_file(&mut self, texts: &BTreeMap<String, String>, path: &str, parent: Option<usize>) -> usize {
        let file = syn::parse_file(&texts[path]).unwrap_or_else(|error| panic!("{path}: {error}"));
        self.files.push(path.to_owned());
        let stem = path.strip_suffix(".rs").unwrap();
        let folder = ["lib", "mod"].iter().find_map(|name| stem.strip_suffix(name)).map(str::to_owned);
        self.read_module(texts, &folder.unwrap_or_else(|| format!("{stem}/")), parent, file.items)
    }

    /// Reads a module of the file read last, with its children, whose files are in a folder.
    fn read_module(
        &mut self,
        texts: &BTreeMap<String, String>,
        folder: &str,
        parent: Option<usize>,
        items: Vec<Item>,
    ) -> usize {
        let (number, file) = (self.modules.len(), self.files.len() - 1);
        let (defined, in_macros) = (BTreeMap::new(), BTreeSet::new());
        self.modules.push(Module { file, parent, defined, in_macros, uses: Vec::new(), code: Vec::new() });
        let (children, code): (Vec<Item>, Vec<Item>) =
            items.into_iter().filter(|item| !is_test(item)).partition(|item| matches!(item, Item::Mod(_)));
        for item in code {
            if let Some(name) = defined_name(&item) {
                self.modules[number].defined.entry(name).or_default().insert(Meaning::Item(file));
            }
            let module = &mut self.modules[number];
            FoundUses(&mut module.uses).visit_item(&item);
            if let Item::Macro(call) = &item {
                for_each_path(TokenBuffer::new2(call.mac.tokens.clone()).begin(), &mut |path| {
                    module.in_macros.extend(path)
                });
            }
            module.code.push(item);
        }
        // The modules within the file first: those of other files become the ones read last.
        let is_within = |item: &Item| matches!(item, Item::Mod(module) if module.content.is_some());
        let (within, others): (Vec<Item>, Vec<Item>) = children.into_iter().partition(is_within);
        for item in within.into_iter().chain(others) {
            let Item::Mod(module) = item else { unreachable!() };
            let name = module.ident.to_string();
            let child = match module.content {
                Some((_, items)) => self.read_module(texts, &format!("{folder}{name}/"), Some(number), items),
                None => {
                    let paths = [format!("{folder}{name}.rs"), format!("{folder}{name}/mod.rs")];
                    let path = paths.iter().find(|path| texts.contains_key(*path));
                    self.read_file(texts, path.unwrap_or_else(|| panic!("none of {paths:?}")), Some(number))
                }
            };
            self.modules[number].defined.entry(name).or_default().insert(Meaning::Module(child));
        }
        number
    }

    /// What a name stands for in a module. `open` are the uses that are being followed.
    fn look_up(&self, module: usize, name: &str, open: &mut Vec<(usize, usize)>) -> BTreeSet<Meaning> {
        let this = &self.modules[module];
        let mut found = this.defined.get(name).cloned().unwrap_or_default();
        let uses = |name: Option<&str>| {
            let uses = this.uses.iter().enumerate().filter(move |(_, one)| one.name.as_deref() == name);
            uses.map(|(number, one)| ((module, number), &one.path)).collect::<Vec<_>>()
        };
        for (id, path) in uses(Some(name)) {
            found.extend(self.follow(module, path, id, open));
        }
        if found.is_empty() && this.in_macros.contains(name) {
            found.insert(Meaning::Item(this.file));
        }
        if found.is_empty() {
            for (id, path) in uses(None) {
                for meaning in self.follow(module, path, id, open) {
                    if let Meaning::Module(source) = meaning {
                        found.extend(self.look_up(source, name, open));
                    }
                }
            }
        }
        found
    }

    /// What the path of a use stands for, unless it is being followed already.
    fn follow(
        &self,
        module: usize,
        path: &[String],
        id: (usize, usize),
        open: &mut Vec<(usize, usize)>,
    ) -> BTreeSet<Meaning> {
        if open.contains(&id) {
            return BTreeSet::new();
        }
        open.push(id);
        let found = self.resolve(module, path, open);
        open.pop();
        found
    }

    /// What a path in a module stands for: nothing if it begins with the name of another crate, or a local one.
    fn resolve(&self, module: usize, path: &[String], open: &mut Vec<(usize, usize)>) -> BTreeSet<Meaning> {
        let mut found: BTreeSet<Meaning> = BTreeSet::new();
        for (at, name) in path.iter().enumerate() {
            let start = match found.first() {
                None => Some(module),
                Some(Meaning::Module(last)) => Some(*last),
                Some(Meaning::Item(_)) => None,
            };
            let next: BTreeSet<Meaning> = match (name.as_str(), start) {
                ("crate", _) => [Meaning::Module(0)].into(),
                ("self", Some(start)) => [Meaning::Module(start)].into(),
                ("super", Some(start)) => self.modules[start].parent.map(Meaning::Module).into_iter().collect(),
                (name, Some(start)) => self.look_up(start, name, open),
                (_, None) => BTreeSet::new(),
            };
            if next.is_empty() {
                // A variant or a function of a type is where the type is.
                found.retain(|meaning| matches!(meaning, Meaning::Item(_)));
                if at == 0 || found.is_empty() {
                    return BTreeSet::new();
                }
                break;
            }
            found = next;
        }
        found
    }

    /// What each file takes from others.
    pub(super) fn imports(&self) -> Imports {
        let mut imports = Imports::new();
        for (number, module) in self.modules.iter().enumerate() {
            let mut add = |path: Vec<String>, is_use: bool| {
                let found = self.resolve(number, &path, &mut Vec::new());
                // Of a module, and of a function of its name beside it, the code takes what it names.
                if is_use && found.iter().any(|meaning| matches!(meaning, Meaning::Module(_))) {
                    return;
                }
                // A type, in a path that goes on to one of its variants or functions.
                let is_type = |word: &&String| word.starts_with(|first: char| first.is_uppercase());
                let name = path.iter().find(is_type).or(path.last()).unwrap();
                for meaning in found {
                    if let Meaning::Item(file) = meaning
                        && file != module.file
                    {
                        let files = (self.files[module.file].clone(), self.files[file].clone());
                        imports.entry(files).or_default().insert(name.clone());
                    }
                }
            };
            for one in module.uses.iter().filter(|one| !one.is_exported && one.name.is_some()) {
                add(one.path.clone(), true);
            }
            let mut paths = FoundPaths(&mut |path| add(path, false));
            module.code.iter().for_each(|item| paths.visit_item(item));
        }
        imports
    }
}

fn is_test(item: &Item) -> bool {
    let attributes: &[Attribute] = match item {
        Item::Const(item) => &item.attrs,
        Item::Fn(item) => &item.attrs,
        Item::Impl(item) => &item.attrs,
        Item::Mod(item) => &item.attrs,
        Item::Use(item) => &item.attrs,
        _ => &[],
    };
    let is_test = |list: &MetaList| list.path.is_ident("cfg") && list.tokens.to_string() == "test";
    attributes.iter().any(|attribute| matches!(&attribute.meta, Meta::List(list) if is_test(list)))
}

/// The name of what an item defines.
fn defined_name(item: &Item) -> Option<String> {
    let name = match item {
        Item::Const(item) => &item.ident,
        Item::Enum(item) => &item.ident,
        Item::Fn(item) => &item.sig.ident,
        Item::Static(item) => &item.ident,
        Item::Struct(item) => &item.ident,
        Item::Trait(item) => &item.ident,
        Item::Type(item) => &item.ident,
        _ => return None,
    };
    Some(name.to_string())
}

/// Collects what is used, in functions too.
struct FoundUses<'a>(&'a mut Vec<Use>);

impl FoundUses<'_> {
    fn add(&mut self, tree: &UseTree, mut path: Vec<String>, is_exported: bool) {
        match tree {
            UseTree::Path(tree) => {
                path.push(tree.ident.to_string());
                self.add(&tree.tree, path, is_exported);
            }
            UseTree::Group(tree) => tree.items.iter().for_each(|tree| self.add(tree, path.clone(), is_exported)),
            UseTree::Glob(_) => self.0.push(Use { name: None, path, is_exported }),
            UseTree::Name(tree) => {
                if tree.ident != "self" {
                    path.push(tree.ident.to_string());
                }
                self.0.push(Use { name: path.last().cloned(), path, is_exported });
            }
            UseTree::Rename(tree) => {
                path.push(tree.ident.to_string());
                self.0.push(Use { name: Some(tree.rename.to_string()), path, is_exported });
            }
        }
    }
}

impl<'ast> Visit<'ast> for FoundUses<'_> {
    fn visit_item_use(&mut self, item: &'ast ItemUse) {
        if item.leading_colon.is_none() {
            self.add(&item.tree, Vec::new(), !matches!(item.vis, Visibility::Inherited));
        }
    }
}

/// Passes on every path in code, of one name or several.
struct FoundPaths<'a>(&'a mut dyn FnMut(Vec<String>));

impl<'ast> Visit<'ast> for FoundPaths<'_> {
    fn visit_item_use(&mut self, _: &'ast ItemUse) {}

    fn visit_path(&mut self, path: &'ast syn::Path) {
        if path.leading_colon.is_none() {
            (self.0)(path.segments.iter().map(|segment| segment.ident.to_string()).collect());
        }
        visit::visit_path(self, path);
    }

    fn visit_macro(&mut self, call: &'ast Macro) {
        for_each_path(TokenBuffer::new2(call.tokens.clone()).begin(), self.0);
    }

    fn visit_attribute(&mut self, attribute: &'ast Attribute) {
        if let Meta::List(list) = &attribute.meta {
            for_each_path(TokenBuffer::new2(list.tokens.clone()).begin(), self.0);
        }
    }
}

/// The name after `::`, and the tokens after it.
fn next_segment(mut tokens: Cursor) -> Option<(syn::Ident, Cursor)> {
    for _ in 0..2 {
        tokens = tokens.punct().filter(|(mark, _)| mark.as_char() == ':')?.1;
    }
    tokens.ident()
}

/// Passes on what looks like a path in tokens, other than fields and methods.
fn for_each_path(mut tokens: Cursor, found: &mut dyn FnMut(Vec<String>)) {
    let mut is_after_dot = false;
    while !tokens.eof() {
        if let Some((name, mut rest)) = tokens.ident() {
            let mut path = vec![name.to_string()];
            while let Some((name, after)) = next_segment(rest) {
                path.push(name.to_string());
                rest = after;
            }
            if !is_after_dot {
                found(path);
            }
            (tokens, is_after_dot) = (rest, false);
        } else if let Some((inside, _, _, rest)) = tokens.any_group() {
            for_each_path(inside, found);
            (tokens, is_after_dot) = (rest, false);
        } else {
            is_after_dot = tokens.punct().is_some_and(|(mark, _)| mark.as_char() == '.');
            tokens = tokens.token_tree().unwrap().1;
        }
    }
}
