//! Everything the library and the program promise, seen from outside; a topic a file.

mod atlas;
mod circuits;
mod house;
mod linkages;
mod manifests;
mod program;
mod readme;
mod thesis;
