//! Everything the library and the program promise, seen from outside; a topic a file.

mod circuits;
mod thesis;
