//! Modes 1 and 2: triangles, each a byte that refers to a recent edge and a recent vertex, plus a few bytes
//! where that is not enough; and lists of indices, each a difference from one of two previous ones.

use crate::formats::gltf::stream::Broken;
use crate::formats::gltf::stream::{Stream, unzigzag};

const HEADER: u8 = 0xe1;
/// The table of frequent pairs.
const TAIL: usize = 16;
/// The codes of a vertex not used by any triangle yet, and of one stored in the data; those in
/// between count recent ones.
const NEW: u8 = 0;
const WRITTEN: u8 = 0xf;

pub(super) fn decode(bytes: &[u8], count: usize) -> Result<Vec<u32>, Broken> {
    let (header, mut body, table) = Stream::open(bytes, TAIL)?;
    if header != HEADER {
        return Err("it does not begin as a list of triangles does");
    }
    let is_pair = |&byte: &u8| byte >> 4 != 0xf && byte & 0xf != 0xf;
    if !table.iter().all(is_pair) || table[14] != 0 || table[15] != 0 {
        return Err("its table of vertices is invalid");
    }
    let codes = body.take(count / 3)?;
    let mut decoder =
        Decoder { data: body, table, next: 0, last: 0, edges: Recent::new(), vertices: Recent::new() };
    let mut indices = Vec::with_capacity(count);
    for &code in codes {
        indices.extend(decoder.triangle(code)?);
    }
    decoder.data.finish()?;
    Ok(indices)
}

/// The last sixteen items.
struct Recent<T> {
    ring: [Option<T>; 16],
    /// The position of the next one.
    at: usize,
}

impl<T: Copy> Recent<T> {
    fn new() -> Self {
        Self { ring: [None; 16], at: 0 }
    }

    fn push(&mut self, item: T) {
        self.ring[self.at] = Some(item);
        self.at = (self.at + 1) % 16;
    }

    /// 0 is the last one, 15 the one to be replaced next.
    fn get(&self, back: u8) -> Result<T, Broken> {
        let index = (self.at + 15 - usize::from(back & 15)) % 16;
        self.ring[index].ok_or("it refers to something before its start")
    }
}

struct Decoder<'b> {
    data: Stream<'b>,
    table: &'b [u8],
    /// The next unused index.
    next: u32,
    /// The last index that was written out.
    last: u32,
    edges: Recent<(u32, u32)>,
    vertices: Recent<u32>,
}

impl Decoder<'_> {
    fn triangle(&mut self, code: u8) -> Result<[u32; 3], Broken> {
        let (high, low) = (code >> 4, code & 0xf);
        match high {
            0xf if low < 0xe => self.looked_up(self.table[usize::from(low)]),
            0xf => self.new_or_written(if low == 0xf { WRITTEN } else { NEW }),
            _ => self.beside_edge(high, low),
        }
    }

    /// A recent edge and one more vertex.
    fn beside_edge(&mut self, edge: u8, vertex: u8) -> Result<[u32; 3], Broken> {
        let (a, b) = self.edges.get(edge)?;
        let c = match vertex {
            0 => self.fresh(),
            1..=0xc => self.vertices.get(vertex)?,
            0xd => self.beside_last(u32::MAX),
            0xe => self.beside_last(1),
            _ => self.written()?,
        };
        self.edges.push((c, b));
        self.edges.push((a, c));
        if !(1..=0xc).contains(&vertex) {
            self.vertices.push(c);
        }
        Ok([a, b, c])
    }

    /// A new vertex and a frequent pair of others.
    fn looked_up(&mut self, pair: u8) -> Result<[u32; 3], Broken> {
        let a = self.fresh();
        let b = self.new_or_recent(pair >> 4)?;
        let c = self.new_or_recent(pair & 0xf)?;
        Ok(self.remember([a, b, c], pair))
    }

    /// Three vertices, encoded individually: the first by `code`, the others by a byte of the data.
    fn new_or_written(&mut self, code: u8) -> Result<[u32; 3], Broken> {
        let pair = self.data.byte()?;
        if pair == 0 {
            self.next = 0;
        }
        let mut vertex = |code: u8| if code == WRITTEN { self.written() } else { self.new_or_recent(code) };
        let corners = [vertex(code)?, vertex(pair >> 4)?, vertex(pair & 0xf)?];
        Ok(self.remember(corners, pair))
    }

    /// All three edges, and the vertices that are not recent already.
    fn remember(&mut self, [a, b, c]: [u32; 3], pair: u8) -> [u32; 3] {
        self.edges.push((b, a));
        self.edges.push((c, b));
        self.edges.push((a, c));
        self.vertices.push(a);
        for (code, vertex) in [(pair >> 4, b), (pair & 0xf, c)] {
            if code == NEW || code == WRITTEN {
                self.vertices.push(vertex);
            }
        }
        [a, b, c]
    }

    fn new_or_recent(&mut self, code: u8) -> Result<u32, Broken> {
        if code == NEW { Ok(self.fresh()) } else { self.vertices.get(code - 1) }
    }

    fn fresh(&mut self) -> u32 {
        let index = self.next;
        self.next = self.next.wrapping_add(1);
        index
    }

    fn beside_last(&mut self, step: u32) -> u32 {
        self.last = self.last.wrapping_add(step);
        self.last
    }

    fn written(&mut self) -> Result<u32, Broken> {
        let delta = unzigzag(self.data.varint()?);
        Ok(self.beside_last(delta))
    }
}

const INDEX_HEADER: u8 = 0xd1;
const INDEX_TAIL: usize = 4;

pub(super) fn decode_indices(bytes: &[u8], count: usize) -> Result<Vec<u32>, Broken> {
    let (header, mut stream, _) = Stream::open(bytes, INDEX_TAIL)?;
    if header != INDEX_HEADER {
        return Err("it does not begin as a sequence of indices does");
    }
    let mut last = [0u32; 2];
    // Not with the claimed capacity: each index takes at least one byte.
    let mut indices = Vec::with_capacity(count.min(stream.0.len()));
    for _ in 0..count {
        let code = stream.varint()?;
        let baseline = &mut last[(code & 1) as usize];
        *baseline = baseline.wrapping_add(unzigzag(code >> 1));
        indices.push(*baseline);
    }
    stream.finish()?;
    Ok(indices)
}
