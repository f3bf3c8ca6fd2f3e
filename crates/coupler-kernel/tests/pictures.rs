//! Moving pictures of the kernel are GIFs with the frames that they were given.

use coupler_kernel::{Kernel, Response};
use gif::{ColorOutput, DecodeOptions, Repeat};
use serde_json::{Value, json};

fn call(kernel: &mut Kernel, request: &Value, numbers: &[f64]) -> (Value, Vec<f64>) {
    let Response { json, numbers } = kernel.call_with_numbers(&request.to_string(), numbers);
    (serde_json::from_str(&json).unwrap(), numbers)
}

const WIDTH: usize = 30;
const HEIGHT: usize = 20;
const PAPER: u32 = 0x00f8_fdff;

/// A line of 256 shades at the top, and a dot that has moved by `step` pixels.
fn frame(step: usize) -> Vec<f64> {
    let color = |at: usize| match at {
        _ if at / WIDTH == 10 && at % WIDTH / 3 == step => 0x0000_00c0,
        0..256 => 0x0001_0101 * at as u32,
        _ => PAPER,
    };
    (0..WIDTH * HEIGHT).map(|at| f64::from(color(at))).collect()
}

fn add(kernel: &mut Kernel, pixels: &[f64]) -> Value {
    let request = json!({ "method": "add_frame", "picture": 0, "pixels": { "$": [0, pixels.len()] }, "delay": 4 });
    call(kernel, &request, pixels).0
}

#[test]
fn frames_are_those_that_were_added() {
    let mut kernel = Kernel::default();
    let open = json!({ "method": "open_picture", "width": WIDTH, "height": HEIGHT });
    assert_eq!(call(&mut kernel, &open, &[]).0["picture"], 0);
    // The fourth is as the third; a frame has what has changed only.
    let frames = [0, 1, 5, 5].map(frame);
    let sizes = frames.each_ref().map(|pixels| add(&mut kernel, pixels)["bytes"].as_u64().unwrap());
    assert!(sizes.windows(2).all(|pair| pair[1] - pair[0] < 50), "{sizes:?}");
    let (_, bytes) = call(&mut kernel, &json!({ "method": "close_picture", "picture": 0 }), &[]);
    let bytes: Vec<u8> = bytes.iter().map(|byte| *byte as u8).collect();

    let mut options = DecodeOptions::new();
    options.set_color_output(ColorOutput::RGBA);
    let mut decoder = options.read_info(bytes.as_slice()).unwrap();
    assert_eq!([decoder.width(), decoder.height()].map(usize::from), [WIDTH, HEIGHT]);
    assert_eq!(decoder.repeat(), Repeat::Infinite);
    let mut shown = vec![[0; 4]; WIDTH * HEIGHT];
    for wanted in &frames {
        let part = decoder.read_next_frame().unwrap().unwrap();
        assert_eq!(part.delay, 4);
        let [left, top, width] = [part.left, part.top, part.width].map(usize::from);
        for (k, pixel) in part.buffer.chunks_exact(4).enumerate().filter(|(_, pixel)| pixel[3] > 0) {
            shown[(top + k / width) * WIDTH + left + k % width] = [pixel[0], pixel[1], pixel[2], pixel[3]];
        }
        for (at, (pixel, wanted)) in shown.iter().zip(wanted).enumerate() {
            let [red, green, blue, _] = (*wanted as u32).to_le_bytes();
            let is_shade = (0..256).contains(&at) && pixel[0] != 0xc0;
            // Shades are those of their groups; all other colours are exact.
            let most = if is_shade { 15 } else { 0 };
            let off = pixel.iter().zip([red, green, blue, 255]).map(|(a, b)| a.abs_diff(b)).max().unwrap();
            assert!(off <= most, "pixel {at}: {pixel:?} instead of {:?}", [red, green, blue]);
        }
    }
    assert!(decoder.read_next_frame().unwrap().is_none());
}

#[test]
fn what_is_no_picture_is_refused() {
    let mut kernel = Kernel::default();
    let error =
        |kernel: &mut Kernel, request: Value| call(kernel, &request, &[]).0["error"].as_str().unwrap().to_owned();
    let empty = json!({ "method": "open_picture", "width": 0, "height": 5 });
    assert!(error(&mut kernel, empty).contains("65,535 pixels"));
    assert!(error(&mut kernel, json!({ "method": "close_picture", "picture": 3 })).contains("not open"));
    call(&mut kernel, &json!({ "method": "open_picture", "width": 2, "height": 2 }), &[]);
    assert_eq!(add(&mut kernel, &[1.0])["error"], "a frame has 1 pixels instead of 4");
    assert!(error(&mut kernel, json!({ "method": "close_picture", "picture": 0 })).contains("needs a frame"));
}
