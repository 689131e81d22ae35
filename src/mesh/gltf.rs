//! glTF 2.0 in its binary form: parts that move, a node for each.

use serde_json::{Value, json};

use super::Mesh;

/// A part of a scene: a mesh in a node of its own.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// The node's name.
    pub name: String,
    /// What is seen, in the node's own coordinates.
    pub mesh: Mesh,
    /// Colour, linear red, green, blue, 0 to 1.
    pub colour: [f32; 3],
    /// Where the node is at first, m, and how it is turned, as a quaternion (x, y, z, w).
    pub pose: ([f32; 3], [f32; 4]),
}

/// How parts move: poses of every part at each time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Motion {
    /// Times that rise, s; none for a scene that stands still.
    pub times: Vec<f32>,
    /// For each part, its pose at each time.
    pub poses: Vec<Vec<([f32; 3], [f32; 4])>>,
}

const FLOAT: u32 = 5126;
const UNSIGNED: u32 = 5125;
const VERTICES: u32 = 34962;
const INDICES: u32 = 34963;

/// The binary chunk and what describes it.
#[derive(Default)]
struct Buffer {
    bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
}

impl Buffer {
    /// Adds numbers of 4 bytes and an accessor to them; returns the accessor's number.
    fn add(
        &mut self,
        words: &[[u8; 4]],
        kind: u32,
        shape: &str,
        count: usize,
        target: Option<u32>,
        bounds: bool,
    ) -> usize {
        let mut view = json!({ "buffer": 0, "byteOffset": self.bytes.len(), "byteLength": 4 * words.len() });
        if let Some(target) = target {
            view["target"] = json!(target);
        }
        let mut accessor =
            json!({ "bufferView": self.views.len(), "componentType": kind, "count": count, "type": shape });
        if bounds {
            let width = words.len() / count.max(1);
            let of = |pick: fn(f32, f32) -> f32, axis: usize| {
                let values = words.iter().skip(axis).step_by(width).map(|word| f32::from_le_bytes(*word));
                values.reduce(pick)
            };
            let all = |pick: fn(f32, f32) -> f32| (0..width).map(|axis| of(pick, axis)).collect::<Vec<_>>();
            accessor["min"] = json!(all(f32::min));
            accessor["max"] = json!(all(f32::max));
        }
        words.iter().for_each(|word| self.bytes.extend(word));
        self.views.push(view);
        self.accessors.push(accessor);
        self.accessors.len() - 1
    }

    fn floats(
        &mut self,
        numbers: &[f32],
        shape: &str,
        width: usize,
        target: Option<u32>,
        bounds: bool,
    ) -> usize {
        let words: Vec<[u8; 4]> = numbers.iter().map(|number| number.to_le_bytes()).collect();
        self.add(&words, FLOAT, shape, numbers.len() / width, target, bounds)
    }
}

/// Parts and how they move, as a GLB file.
pub fn glb(parts: &[Part], motion: &Motion) -> Vec<u8> {
    let mut buffer = Buffer::default();
    let (mut nodes, mut meshes, mut materials) = (Vec::new(), Vec::new(), Vec::<Value>::new());
    for part in parts {
        let Mesh { points, normals, triangles } = &part.mesh;
        let position = buffer.floats(points.as_flattened(), "VEC3", 3, Some(VERTICES), true);
        let normal = buffer.floats(normals.as_flattened(), "VEC3", 3, Some(VERTICES), false);
        let corners: Vec<[u8; 4]> = triangles.iter().flatten().map(|corner| corner.to_le_bytes()).collect();
        let indices = buffer.add(&corners, UNSIGNED, "SCALAR", corners.len(), Some(INDICES), false);
        let [r, g, b] = part.colour;
        let material = json!({ "pbrMetallicRoughness": {
            "baseColorFactor": [r, g, b, 1.0], "metallicFactor": 0.0, "roughnessFactor": 0.9
        } });
        let which = materials.iter().position(|known| *known == material).unwrap_or_else(|| {
            materials.push(material);
            materials.len() - 1
        });
        nodes.push(json!({
            "name": part.name, "mesh": meshes.len(), "translation": part.pose.0, "rotation": part.pose.1
        }));
        meshes.push(json!({ "primitives": [{
            "attributes": { "POSITION": position, "NORMAL": normal }, "indices": indices, "material": which
        }] }));
    }
    let mut document = json!({
        "asset": { "version": "2.0", "generator": "snowglobe" },
        "scene": 0,
        "scenes": [{ "nodes": (0..nodes.len()).collect::<Vec<_>>() }],
        "nodes": nodes,
        "meshes": meshes,
        "materials": materials,
    });
    if !motion.times.is_empty() {
        document["animations"] = json!([animation(&mut buffer, motion)]);
    }
    document["accessors"] = json!(buffer.accessors);
    document["bufferViews"] = json!(buffer.views);
    document["buffers"] = json!([{ "byteLength": buffer.bytes.len() }]);
    container(document.to_string().into_bytes(), buffer.bytes)
}

fn animation(buffer: &mut Buffer, motion: &Motion) -> Value {
    let times = buffer.floats(&motion.times, "SCALAR", 1, None, true);
    let (mut samplers, mut channels) = (Vec::new(), Vec::new());
    for (node, poses) in motion.poses.iter().enumerate() {
        let places: Vec<f32> = poses.iter().flat_map(|(place, _)| *place).collect();
        let mut turns: Vec<[f32; 4]> = poses.iter().map(|(_, turn)| *turn).collect();
        // A quaternion and its opposite are the same turn; the nearer one is the way to go.
        for k in 1..turns.len() {
            let along: f32 = turns[k - 1].iter().zip(&turns[k]).map(|(a, b)| a * b).sum();
            if along < 0.0 {
                turns[k] = turns[k].map(|x| -x);
            }
        }
        let output = [
            ("translation", buffer.floats(&places, "VEC3", 3, None, false)),
            ("rotation", buffer.floats(turns.as_flattened(), "VEC4", 4, None, false)),
        ];
        for (path, output) in output {
            channels.push(json!({ "sampler": samplers.len(), "target": { "node": node, "path": path } }));
            samplers.push(json!({ "input": times, "output": output, "interpolation": "LINEAR" }));
        }
    }
    json!({ "name": "sway", "samplers": samplers, "channels": channels })
}

/// Header, JSON padded by blanks, bytes padded by zeros.
fn container(mut text: Vec<u8>, mut bytes: Vec<u8>) -> Vec<u8> {
    text.resize(text.len().next_multiple_of(4), b' ');
    bytes.resize(bytes.len().next_multiple_of(4), 0);
    let total = 12 + 8 + text.len() + 8 + bytes.len();
    let mut file = Vec::with_capacity(total);
    file.extend(b"glTF");
    file.extend(2_u32.to_le_bytes());
    file.extend((total as u32).to_le_bytes());
    for (kind, chunk) in [(b"JSON", &text), (b"BIN\0", &bytes)] {
        file.extend((chunk.len() as u32).to_le_bytes());
        file.extend(kind);
        file.extend(chunk);
    }
    file
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_accessor_lies_within_its_view_and_every_view_within_the_file() {
        let part = |name: &str| Part {
            name: name.to_owned(),
            mesh: Mesh::stick(1.0, [0.2, 0.1], 6),
            colour: [0.3, 0.2, 0.1],
            pose: ([0.0; 3], [0.0, 0.0, 0.0, 1.0]),
        };
        let pose = |x: f32, w: f32| ([x, 0.0, 0.0], [0.0, 0.0, 0.0, w]);
        let poses = vec![vec![pose(0.0, 1.0), pose(1.0, -1.0)], vec![pose(0.0, 1.0), pose(2.0, 1.0)]];
        let file = glb(&[part("a"), part("b")], &Motion { times: vec![0.0, 0.5], poses });
        assert_eq!((&file[..4], file.len() % 4), (&b"glTF"[..], 0));
        let word = |at: usize| u32::from_le_bytes(file[at..at + 4].try_into().unwrap()) as usize;
        assert_eq!(word(8), file.len());
        let text = word(12);
        let document: Value = serde_json::from_slice(&file[20..20 + text]).unwrap();
        let bytes = &file[28 + text..];
        assert_eq!(
            (word(20 + text), document["buffers"][0]["byteLength"].as_u64().unwrap()),
            (bytes.len(), bytes.len() as u64)
        );
        for accessor in document["accessors"].as_array().unwrap() {
            let width = match accessor["type"].as_str().unwrap() {
                "SCALAR" => 1,
                "VEC3" => 3,
                _ => 4,
            };
            let view = &document["bufferViews"][accessor["bufferView"].as_u64().unwrap() as usize];
            let (from, length) = (view["byteOffset"].as_u64().unwrap(), view["byteLength"].as_u64().unwrap());
            assert_eq!(accessor["count"].as_u64().unwrap() * width * 4, length);
            assert!(from % 4 == 0 && (from + length) as usize <= bytes.len());
        }
        assert_eq!(document["nodes"].as_array().unwrap().len(), 2);
        assert_eq!(document["materials"].as_array().unwrap().len(), 1);
        let channels = document["animations"][0]["channels"].as_array().unwrap();
        assert_eq!(channels.len(), 4);
        // The second turn of the first part was turned to the nearer of its two forms.
        let output = document["animations"][0]["samplers"][1]["output"].as_u64().unwrap() as usize;
        let view =
            &document["bufferViews"][document["accessors"][output]["bufferView"].as_u64().unwrap() as usize];
        let at = view["byteOffset"].as_u64().unwrap() as usize + 28;
        assert_eq!(f32::from_le_bytes(bytes[at..at + 4].try_into().unwrap()), 1.0);
    }
}
