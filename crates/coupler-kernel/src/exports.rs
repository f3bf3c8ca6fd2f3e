//! The functions that the module exports. The page passes and gets bytes and numbers in linear memory.

#![allow(unsafe_code, reason = "the page and the module share linear memory")]

use std::cell::RefCell;

use crate::kernel::Kernel;
use crate::response::Response;

/// What the page reads after a call, until the next one.
#[derive(Default)]
struct Module {
    kernel: Kernel,
    /// The numbers of the next request.
    numbers: Vec<f64>,
    response: Response,
    /// The places and lengths of the response's parts.
    parts: [usize; 4],
    pose: Vec<f64>,
}

thread_local! {
    static MODULE: RefCell<Module> = RefCell::default();
    /// The message of the panic that has stopped the module. A panic during a call leaves `MODULE` borrowed.
    static PANIC: RefCell<String> = const { RefCell::new(String::new()) };
}

/// Prepares the module; the page calls it once.
#[unsafe(no_mangle)]
pub extern "C" fn kernel_start() {
    std::panic::set_hook(Box::new(|panic| PANIC.with(|message| *message.borrow_mut() = panic.to_string())));
}

/// Memory for a request of some bytes, which [`kernel_call`] takes back.
#[unsafe(no_mangle)]
pub extern "C" fn kernel_allocate(length: usize) -> *mut u8 {
    Box::into_raw(vec![0u8; length].into_boxed_slice()).cast()
}

/// Memory for the numbers of the next request.
#[unsafe(no_mangle)]
pub extern "C" fn kernel_numbers(count: usize) -> *mut f64 {
    MODULE.with_borrow_mut(|module| {
        module.numbers = vec![0.0; count];
        module.numbers.as_mut_ptr()
    })
}

/// Answers a request in UTF-8 with the numbers of [`kernel_numbers`]. Returns four numbers of the size of a pointer: place and length of the response's JSON,
/// and place and count of its numbers.
///
/// # Safety
/// `request` comes from [`kernel_allocate`] with this length, and is not used again.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn kernel_call(request: *mut u8, length: usize) -> *const usize {
    // SAFETY: by the contract of this function, this is the box that `kernel_allocate` made.
    let request = unsafe { Box::from_raw(std::ptr::slice_from_raw_parts_mut(request, length)) };
    MODULE.with_borrow_mut(|module| {
        let numbers = std::mem::take(&mut module.numbers);
        module.response = module.kernel.call_with_numbers(&String::from_utf8_lossy(&request), &numbers);
        let Response { json, numbers } = &module.response;
        module.parts = [json.as_ptr() as usize, json.len(), numbers.as_ptr() as usize, numbers.len()];
        module.parts.as_ptr()
    })
}

/// The numbers of a pose, see [`Kernel::pose`]; their count is [`kernel_pose_length`].
#[unsafe(no_mangle)]
pub extern "C" fn kernel_pose(study: usize, pass: usize, input: f64) -> *const f64 {
    MODULE.with_borrow_mut(|Module { kernel, pose, .. }| {
        kernel.pose(study, pass, input, pose);
        pose.as_ptr()
    })
}

/// The count of the numbers of the last pose.
#[unsafe(no_mangle)]
pub extern "C" fn kernel_pose_length() -> usize {
    MODULE.with_borrow(|module| module.pose.len())
}

/// The position of a joint, see [`Kernel::joint_position`]: two numbers.
#[unsafe(no_mangle)]
pub extern "C" fn kernel_joint_position(study: usize, joint: usize, pass: usize, input: f64) -> *const f64 {
    MODULE.with_borrow_mut(|Module { kernel, pose, .. }| {
        pose.clear();
        pose.extend(kernel.joint_position(study, joint, pass, input));
        pose.as_ptr()
    })
}

/// The message of the panic that has stopped the module, in UTF-8; its length is [`kernel_panic_length`].
#[unsafe(no_mangle)]
pub extern "C" fn kernel_panic_message() -> *const u8 {
    PANIC.with_borrow(|message| message.as_ptr())
}

/// The length of the message of the panic.
#[unsafe(no_mangle)]
pub extern "C" fn kernel_panic_length() -> usize {
    PANIC.with_borrow(String::len)
}
