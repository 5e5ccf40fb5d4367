//! The other direction, for tests: writes streams that use every code of the
//! format, without caring how small they are.

/// How a channel's deltas are made; the same as the decoder's, written anew.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum ChannelMode {
    Bytes,
    Words,
    Bits(u32),
}

impl ChannelMode {
    fn code(self) -> u8 {
        match self {
            Self::Bytes => 0,
            Self::Words => 1,
            Self::Bits(rotation) => 2 | (rotation as u8) << 4,
        }
    }

    fn delta(self, from: &[u8], to: &[u8]) -> [u8; 4] {
        let zigzag = |delta: i64, bits: u32| ((delta << 1) ^ (delta >> 63)) as u64 & ((1 << bits) - 1);
        match self {
            Self::Bytes => {
                std::array::from_fn(|i| zigzag(i64::from(to[i].wrapping_sub(from[i]) as i8), 8) as u8)
            }
            Self::Words => {
                let word = |bytes: &[u8], at: usize| u16::from_le_bytes([bytes[at], bytes[at + 1]]);
                let delta =
                    |at| zigzag(i64::from(word(to, at).wrapping_sub(word(from, at)) as i16), 16) as u16;
                let ([a, b], [c, d]) = (delta(0).to_le_bytes(), delta(2).to_le_bytes());
                [a, b, c, d]
            }
            Self::Bits(rotation) => {
                let bits = |bytes: &[u8]| u32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]);
                (bits(from) ^ bits(to)).rotate_left(rotation).to_le_bytes()
            }
        }
    }
}

/// Version 1 with modes for the channels, version 0 without.
pub(super) fn encode_attributes(bytes: &[u8], stride: usize, modes: Option<&[ChannelMode]>) -> Vec<u8> {
    let plain = vec![ChannelMode::Bytes; stride / 4];
    let channels = modes.unwrap_or(&plain);
    let baseline = bytes[..stride].to_vec();
    let mut stream = vec![if modes.is_some() { 0xa1 } else { 0xa0 }];
    let mut previous = baseline.clone();
    let block = (8192 / stride / 16 * 16).min(256);
    for elements in bytes.chunks(block * stride) {
        let mut columns = vec![Vec::new(); stride];
        for element in elements.chunks_exact(stride) {
            for (index, channel) in channels.iter().enumerate() {
                let range = 4 * index..4 * index + 4;
                let delta = channel.delta(&previous[range.clone()], &element[range]);
                (0..4).for_each(|byte| columns[4 * index + byte].push(delta[byte]));
            }
            previous = element.to_vec();
        }
        encode_block(&mut stream, &columns, modes.is_some());
    }
    let tail_start = stream.len();
    let tail = stride + modes.map_or(0, |modes| modes.len());
    stream.resize(tail_start + if modes.is_some() { 24 } else { 32_usize }.saturating_sub(tail), 0);
    stream.extend(baseline);
    stream.extend(modes.iter().flat_map(|modes| modes.iter().map(|mode| mode.code())));
    stream
}

fn encode_block(stream: &mut Vec<u8>, columns: &[Vec<u8>], has_control: bool) {
    // Each column takes another control mode where it can.
    let control: Vec<u8> = columns
        .iter()
        .enumerate()
        .map(|(index, column)| match index % 4 {
            _ if column.iter().all(|&delta| delta == 0) => 2,
            3 => 3,
            other => (other % 2) as u8,
        })
        .collect();
    if has_control {
        let pack = |four: &[u8]| four.iter().rev().fold(0, |byte, mode| byte << 2 | mode);
        stream.extend(control.chunks_exact(4).map(pack));
    }
    for (column, &control) in columns.iter().zip(&control) {
        match (has_control, control) {
            (true, 2) => {}
            (true, 3) => stream.extend(column),
            (true, 0) => encode_column(stream, column, &[0, 1, 2, 4]),
            (true, _) => encode_column(stream, column, &[1, 2, 4, 8]),
            (false, _) => encode_column(stream, column, &[0, 2, 4, 8]),
        }
    }
}

fn encode_column(stream: &mut Vec<u8>, column: &[u8], widths: &[usize; 4]) {
    let mut padded = column.to_vec();
    padded.resize(column.len().next_multiple_of(16), 0);
    let groups: Vec<&[u8]> = padded.chunks_exact(16).collect();
    let cost = |group: &[u8], width: usize| match width {
        0 if group.iter().any(|&delta| delta != 0) => usize::MAX,
        0 | 8 => 2 * width,
        _ => 2 * width + group.iter().filter(|&&delta| delta >= (1 << width) - 1).count(),
    };
    let choice = |group: &&[u8]| (0..4).min_by_key(|&index| cost(group, widths[index])).expect("four widths");
    let choices: Vec<usize> = groups.iter().map(choice).collect();
    let pack = |four: &[usize]| four.iter().rev().fold(0, |byte, &bits| byte << 2 | bits as u8);
    stream.extend(choices.chunks(4).map(pack));
    for (group, choice) in groups.iter().zip(choices) {
        encode_group(stream, group, widths[choice]);
    }
}

fn encode_group(stream: &mut Vec<u8>, group: &[u8], width: usize) {
    if width == 8 {
        return stream.extend(group);
    }
    if width == 0 {
        return;
    }
    let escape = (1u8 << width) - 1;
    let coded: Vec<u8> = group.iter().map(|&delta| delta.min(escape)).collect();
    for byte in coded.chunks_exact(8 / width) {
        let join = |byte: u8, value: &u8| byte << width | value;
        stream.push(if width == 1 { byte.iter().rev().fold(0, join) } else { byte.iter().fold(0, join) });
    }
    stream.extend(group.iter().filter(|&&delta| delta >= escape));
}

/// Unsigned LEB128 of a zigzag-encoded difference.
fn push_delta(stream: &mut Vec<u8>, delta: u32, extra: Option<u32>) {
    let mut value = delta << 1 ^ if delta >> 31 == 1 { u32::MAX } else { 0 };
    if let Some(bit) = extra {
        value = value << 1 | bit;
    }
    while value >= 0x80 {
        stream.push(value as u8 | 0x80);
        value >>= 7;
    }
    stream.push(value as u8);
}

pub(super) fn encode_indices(indices: &[u32]) -> Vec<u8> {
    let mut stream = vec![0xd1];
    let mut last = [0u32; 2];
    for &index in indices {
        let far = |baseline: u32| index.abs_diff(baseline);
        let nearer = usize::from(far(last[1]) < far(last[0]));
        push_delta(&mut stream, index.wrapping_sub(last[nearer]), Some(nearer as u32));
        last[nearer] = index;
    }
    stream.extend([0; 4]);
    stream
}

/// The newest first, at most sixteen.
fn remember<T>(list: &mut Vec<T>, item: T) {
    list.insert(0, item);
    list.truncate(16);
}

pub(super) fn encode_triangles(indices: &[u32]) -> Vec<u8> {
    const TABLE: [u8; 16] = [0x00, 0x10, 0x01, 0x12, 0x21, 0x34, 0x56, 0x20, 0, 0, 0, 0, 0, 0, 0, 0];
    let (mut codes, mut data) = (Vec::new(), Vec::new());
    let (mut edges, mut vertices) = (Vec::new(), Vec::<u32>::new());
    let (mut next, mut last) = (0u32, 0u32);
    for corner in indices.chunks_exact(3) {
        let (a, b, c) = (corner[0], corner[1], corner[2]);
        let recent = |vertices: &[u32], v: u32| vertices.iter().position(|&other| other == v);
        if let Some(edge) = edges.iter().position(|&edge| edge == (a, b)).filter(|&edge| edge < 15) {
            let code = match recent(&vertices, c) {
                _ if c == next => 0,
                Some(at @ 1..=12) => at as u8,
                _ if c.wrapping_add(1) == last => 0xd,
                _ if c == last.wrapping_add(1) => 0xe,
                _ => 0xf,
            };
            codes.push((edge as u8) << 4 | code);
            match code {
                0 => next += 1,
                0xf => push_delta(&mut data, c.wrapping_sub(last), None),
                _ => {}
            }
            if code >= 0xd {
                last = c;
            }
            remember(&mut edges, (c, b));
            remember(&mut edges, (a, c));
            if code == 0 || code >= 0xd {
                remember(&mut vertices, c);
            }
            continue;
        }
        let is_first_new = a == next;
        let mut after = next + u32::from(is_first_new);
        let mut code_of = |v: u32| match recent(&vertices, v) {
            _ if v == after => {
                after += 1;
                0
            }
            Some(at @ 0..=13) => at as u8 + 1,
            _ => 0xf,
        };
        let (of_b, of_c) = (code_of(b), code_of(c));
        let pair = of_b << 4 | of_c;
        // A pair of two new ones would count anew where it is written out.
        let in_table = TABLE[..14].iter().position(|&known| known == pair).filter(|_| is_first_new);
        let pair = if pair == 0 && in_table.is_none() { 0xff } else { pair };
        let written = |code: u8| code == 0xf;
        match in_table {
            Some(at) => codes.push(0xf0 | at as u8),
            None => {
                codes.push(if is_first_new { 0xfe } else { 0xff });
                data.push(pair);
                let mut write = |v: u32| {
                    push_delta(&mut data, v.wrapping_sub(last), None);
                    last = v;
                };
                if !is_first_new {
                    write(a);
                }
                for (code, v) in [(pair >> 4, b), (pair & 0xf, c)] {
                    if written(code) {
                        write(v);
                    }
                }
            }
        }
        next += u32::from(is_first_new) + u32::from(pair >> 4 == 0) + u32::from(pair & 0xf == 0);
        remember(&mut edges, (b, a));
        remember(&mut edges, (c, b));
        remember(&mut edges, (a, c));
        remember(&mut vertices, a);
        for (code, v) in [(pair >> 4, b), (pair & 0xf, c)] {
            if code == 0 || written(code) {
                remember(&mut vertices, v);
            }
        }
    }
    [&[0xe1], codes.as_slice(), &data, &TABLE].concat()
}
