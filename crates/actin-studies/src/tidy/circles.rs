//! Import circles between the modules of a folder.
//!
//! A module includes its submodules. A submodule may use the items of its parent, so that only modules of one folder are
//! compared. Tests are excluded.

use super::files;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use syn::visit::{self, Visit};
use syn::{Attribute, Item, ItemUse, UseTree, Visibility};

/// Folders with modules that still use each other in a circle: laws contain materials, which contain laws; the parts of a
/// scene are checked against the whole. This table may only shrink.
const REMAINING: [(&str, &str); 2] = [
    (
        "crates/actin-cosserat/src",
        "bending extended fast homogenised material shear",
    ),
    (
        "crates/actin-scene/src",
        "adaptive_resolution arrangement bead brownian crosslinkers curve drag factor flow imperfection \
         kinetics linker linkers_between load load_rules numbers observable path periodic place repulsion \
         rest rules scene_file section_rules sections shape stage support thermal types validate",
    ),
];

/// Path of a module below its crate; empty for the root.
type Module = Vec<String>;

/// Items and imports of a module file.
#[derive(Default)]
struct Source {
    items: BTreeSet<String>,
    /// Names of imports and re-exports with their paths; `*` for globs.
    imports: Vec<(String, Vec<String>)>,
    /// Other paths of two or more segments.
    paths: Vec<Vec<String>>,
    /// Child modules for tests.
    tests: BTreeSet<String>,
    /// Names of re-exports.
    exported: BTreeSet<String>,
}

fn is_test(attributes: &[Attribute]) -> bool {
    attributes.iter().any(|attribute| {
        attribute.path().is_ident("test")
            || attribute.path().is_ident("cfg")
                && attribute
                    .parse_args::<syn::Path>()
                    .is_ok_and(|path| path.is_ident("test"))
    })
}

impl Source {
    fn add_tree(&mut self, tree: &UseTree, prefix: &[String], is_exported: bool) {
        let with = |name: String| [prefix, &[name]].concat();
        let (name, path) = match tree {
            UseTree::Path(path) => {
                let prefix = with(path.ident.to_string());
                return self.add_tree(&path.tree, &prefix, is_exported);
            }
            UseTree::Group(group) => {
                for tree in &group.items {
                    self.add_tree(tree, prefix, is_exported);
                }
                return;
            }
            UseTree::Name(name) if name.ident == "self" => {
                (prefix.last().cloned().unwrap_or_default(), prefix.to_vec())
            }
            UseTree::Name(name) => (name.ident.to_string(), with(name.ident.to_string())),
            UseTree::Rename(rename) => (rename.rename.to_string(), with(rename.ident.to_string())),
            UseTree::Glob(_) => ("*".to_owned(), with("*".to_owned())),
        };
        if is_exported {
            self.exported.insert(name.clone());
        }
        self.imports.push((name, path));
    }
}

impl<'ast> Visit<'ast> for Source {
    fn visit_item(&mut self, item: &'ast Item) {
        let (attributes, name) = match item {
            Item::Const(item) => (&item.attrs, Some(&item.ident)),
            Item::Enum(item) => (&item.attrs, Some(&item.ident)),
            Item::Fn(item) => (&item.attrs, Some(&item.sig.ident)),
            Item::Static(item) => (&item.attrs, Some(&item.ident)),
            Item::Struct(item) => (&item.attrs, Some(&item.ident)),
            Item::Trait(item) => (&item.attrs, Some(&item.ident)),
            Item::Type(item) => (&item.attrs, Some(&item.ident)),
            Item::Impl(item) => (&item.attrs, None),
            Item::Use(item) => (&item.attrs, None),
            Item::Mod(item) if is_test(&item.attrs) => {
                self.tests.insert(item.ident.to_string());
                return;
            }
            _ => return visit::visit_item(self, item),
        };
        if is_test(attributes) {
            return;
        }
        self.items.extend(name.map(ToString::to_string));
        visit::visit_item(self, item);
    }

    fn visit_item_use(&mut self, item: &'ast ItemUse) {
        let is_exported = !matches!(item.vis, Visibility::Inherited);
        self.add_tree(&item.tree, &[], is_exported);
    }

    fn visit_path(&mut self, path: &'ast syn::Path) {
        let segments = path.segments.iter();
        let names: Vec<_> = segments.map(|one| one.ident.to_string()).collect();
        if names.len() > 1 {
            self.paths.push(names);
        }
        visit::visit_path(self, path);
    }
}

/// Modules of a crate without those for tests.
struct Crate(BTreeMap<Module, Source>);

impl Crate {
    fn read(folder: &Path) -> Result<Self, String> {
        let mut modules = BTreeMap::new();
        for (path, text) in files(folder, "rs")? {
            let mut source = Source::default();
            let file = syn::parse_file(&text).map_err(|e| format!("{}: {e}", path.display()))?;
            source.visit_file(&file);
            let relative = path.strip_prefix(folder).unwrap_or(&path);
            let relative = relative.with_extension("");
            let mut module: Module = relative
                .iter()
                .map(|part| part.to_string_lossy().into())
                .collect();
            module.pop_if(|name| ["mod", "lib", "main"].contains(&name.as_str()));
            modules.insert(module, source);
        }
        let is_product = |module: &Module| {
            !(0..module.len()).any(|i| {
                let parent: Option<&Source> = modules.get(&module[..i]);
                parent.is_some_and(|parent| parent.tests.contains(&module[i]))
            })
        };
        let product: BTreeSet<Module> = modules.keys().filter(|m| is_product(m)).cloned().collect();
        modules.retain(|module, _| product.contains(module));
        Ok(Self(modules))
    }

    /// Returns the module that defines the item of a path used in `module`; `None` for items of other crates.
    fn definition(&self, module: &[String], path: &[String], depth: usize) -> Option<Module> {
        let (first, mut rest) = path.split_first()?;
        let mut place = module.to_vec();
        match first.as_str() {
            "crate" => place.clear(),
            "self" => {}
            "super" => {
                place.pop();
                while let Some(("super", after)) = rest.split_first().map(|(a, b)| (a.as_str(), b))
                {
                    place.pop();
                    rest = after;
                }
            }
            _ => rest = path,
        }
        while let Some((name, after)) = rest.split_first() {
            let child = [place.as_slice(), std::slice::from_ref(name)].concat();
            if !self.0.contains_key(&child) {
                break;
            }
            (place, rest) = (child, after);
        }
        let source = self.0.get(&place)?;
        let (name, after) = rest.split_first()?;
        if name == "*" || source.items.contains(name) {
            return Some(place);
        }
        // Depth ends glob imports of each other.
        if depth > 8 {
            return None;
        }
        let named = source.imports.iter().find(|(known, _)| known == name);
        if let Some((_, path)) = named {
            return self.definition(&place, &[path, after].concat(), depth + 1);
        }
        let mut globs = source.imports.iter().filter(|(known, _)| known == "*");
        globs.find_map(|(_, path)| {
            let (_, path) = path.split_last()?;
            self.definition(&place, &[path, rest].concat(), depth + 1)
        })
    }

    /// Returns each module with the modules and names of the items that it uses.
    fn dependencies(&self) -> BTreeMap<&Module, BTreeSet<(Module, &String)>> {
        let modules = self.0.iter().map(|(module, source)| {
            let imports = source.imports.iter();
            let imports = imports.filter(|(name, _)| !source.exported.contains(name));
            let paths = imports.map(|(_, path)| path).chain(&source.paths);
            let found =
                paths.filter_map(|path| Some((self.definition(module, path, 0)?, path.last()?)));
            (module, found.collect())
        });
        modules.collect()
    }

    /// Returns the uses of modules by others of the same folder.
    fn uses_in(&self, folder: &[String]) -> Uses {
        let child = |module: &Module| module.strip_prefix(folder)?.first().cloned();
        let mut uses = Uses::new();
        for (module, used) in self.dependencies() {
            let Some(from) = child(module) else { continue };
            let uses = uses.entry(from.clone()).or_default();
            for (place, name) in used {
                let Some(to) = child(&place).filter(|to| *to != from) else {
                    continue;
                };
                uses.entry(to).or_default().insert(name.clone());
            }
        }
        uses
    }

    fn folders(&self) -> BTreeSet<&[String]> {
        let below_root = self.0.keys().filter_map(|module| module.split_last());
        below_root.map(|(_, folder)| folder).collect()
    }
}

/// For each module of a folder the modules that it uses, with the names of the items.
type Uses = BTreeMap<String, BTreeMap<String, BTreeSet<String>>>;

/// Returns the sets of two or more modules that use each other, directly or through others.
fn circles(uses: &Uses) -> Vec<BTreeSet<String>> {
    let reached = |from: &String| {
        let mut found = BTreeSet::new();
        let mut next = vec![from];
        while let Some(module) = next.pop() {
            let new = uses[module].keys().filter(|to| found.insert(*to));
            next.extend(new.collect::<Vec<_>>());
        }
        found
    };
    let reached: BTreeMap<_, _> = uses.keys().map(|from| (from, reached(from))).collect();
    let mut all = Vec::new();
    for (module, to) in reached.iter().filter(|(module, to)| to.contains(*module)) {
        let circle = to.iter().filter(|other| reached[**other].contains(*module));
        let circle: BTreeSet<String> = circle.map(|name| (*name).clone()).collect();
        if !all.contains(&circle) {
            all.push(circle);
        }
    }
    all
}

/// Text with each use inside of a circle.
fn in_words(uses: &Uses, circle: &BTreeSet<String>) -> String {
    let lines = circle.iter().flat_map(|from| {
        let inside = uses[from].iter().filter(|(to, _)| circle.contains(*to));
        inside.map(move |(to, names)| {
            let names: Vec<_> = names.iter().map(String::as_str).collect();
            format!("\n    {from} uses {} of {to}", names.join(", "))
        })
    });
    lines.collect()
}

/// Crate folder or folder in it, and modules.
type Circle = (String, BTreeSet<String>);

fn known() -> Vec<Circle> {
    let all = REMAINING.iter();
    all.map(|(folder, names)| {
        let names = names.split(' ').map(str::to_owned);
        ((*folder).to_owned(), names.collect())
    })
    .collect()
}

pub(super) fn findings(root: &Path) -> Result<Vec<String>, String> {
    let mut all = Vec::new();
    let mut known = known();
    let crates = std::fs::read_dir(root.join("crates")).map_err(|e| e.to_string())?;
    for one in crates {
        let sources = one.map_err(|e| e.to_string())?.path().join("src");
        let modules = Crate::read(&sources)?;
        for below in modules.folders() {
            let folder = below
                .iter()
                .fold(sources.clone(), |folder, name| folder.join(name));
            let name = folder
                .strip_prefix(root)
                .unwrap_or(&folder)
                .display()
                .to_string();
            let uses = modules.uses_in(below);
            for circle in circles(&uses) {
                let words = in_words(&uses, &circle);
                let circle = (name.clone(), circle);
                match known.iter().position(|one| *one == circle) {
                    Some(i) => drop(known.remove(i)),
                    None => all.push(format!(
                        "{name}: modules use each other in a circle:{words}"
                    )),
                }
            }
        }
    }
    all.extend(known.iter().map(|(folder, _)| {
        format!("{folder}: a circle is gone or smaller: correct tidy/circles.rs")
    }));
    Ok(all)
}
