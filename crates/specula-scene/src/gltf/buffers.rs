//! Bytes: buffers and files, embedded or beside the scene.

use std::path::{Component, Path};

use base64::Engine;
use base64::engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig};

use super::{LostBuffer, Reader};
use crate::error::{ErrorKind, SceneError};

/// Base64 with or without its padding.
const BASE64: GeneralPurpose = GeneralPurpose::new(
    &base64::alphabet::STANDARD,
    GeneralPurposeConfig::new().with_decode_padding_mode(DecodePaddingMode::Indifferent),
);

impl Reader<'_> {
    /// All buffers, each at least as long as it promises.
    pub(super) fn read_buffers(
        &self,
        blob: Option<Vec<u8>>,
    ) -> Result<Vec<Result<Vec<u8>, LostBuffer>>, SceneError> {
        let mut blob = blob;
        let mut found = Vec::new();
        for buffer in self.document.buffers() {
            let what = format!("buffers[{}]", buffer.index());
            found.push(match self.read_buffer(&what, &buffer, &mut blob) {
                Ok(bytes) => Ok(bytes),
                Err(error) => {
                    let lost = (error.message().to_owned(), error.missing().to_vec());
                    self.problems.record(error)?;
                    Err(lost)
                }
            });
        }
        Ok(found)
    }

    fn read_buffer(
        &self,
        what: &str,
        buffer: &gltf::Buffer<'_>,
        blob: &mut Option<Vec<u8>>,
    ) -> Result<Vec<u8>, SceneError> {
        let bytes = match buffer.source() {
            gltf::buffer::Source::Bin => blob.take().ok_or_else(|| {
                let message = format!("{what} is the binary part, but there is none");
                self.error(ErrorKind::Structure, message)
            })?,
            gltf::buffer::Source::Uri(uri) => {
                (self.resource(what, uri)).map_err(|error| error.of_missing(ErrorKind::Mesh))?
            }
        };
        if bytes.len() < buffer.length() {
            let message = format!(
                "{what} has {} bytes; expected {}",
                bytes.len(),
                buffer.length()
            );
            return Err(self.error(ErrorKind::Mesh, message));
        }
        Ok(bytes)
    }

    /// What a URI leads to: embedded data, or a file in the scene's folder or below.
    pub(super) fn resource(&self, what: &str, uri: &str) -> Result<Vec<u8>, SceneError> {
        let wrong = |message: String| self.error(ErrorKind::Io, format!("{what}: {message}"));
        if let Some(data) = uri.strip_prefix("data:") {
            let (head, body) = data
                .split_once(',')
                .ok_or_else(|| wrong("a data URI without a comma".to_owned()))?;
            if !head.ends_with(";base64") {
                return Err(wrong("expected a data URI in base64".to_owned()));
            }
            return BASE64
                .decode(body.trim_ascii())
                .map_err(|e| wrong(format!("not base64: {e}")));
        }
        if uri.contains("://") {
            return Err(wrong(format!(
                "expected a file, found the address {uri:?}: nothing is fetched from a network"
            )));
        }
        let name = percent_encoding::percent_decode_str(uri)
            .decode_utf8()
            .map_err(|_| wrong(format!("{uri:?} is not UTF-8")))?;
        let path = Path::new(name.as_ref());
        if path
            .components()
            .any(|c| matches!(c, Component::RootDir | Component::Prefix(_)))
        {
            return Err(wrong(format!(
                "expected a file beside the scene, found {uri:?}"
            )));
        }
        let path = self.search.find(&name);
        self.files
            .unpacked(&path)
            .map_err(|message| wrong(message).if_missing(self.search.hint(&path), &path))
    }

    /// The bytes of a view.
    pub(super) fn view(
        &self,
        what: &str,
        view: &gltf::buffer::View<'_>,
    ) -> Result<&[u8], SceneError> {
        let bytes = match self.buffers.get(view.buffer().index()) {
            // Its error is recorded already, once.
            Some(Err((message, missing))) => {
                let error = self.error(ErrorKind::Io, message);
                return Err(error.with_missing(missing.clone()));
            }
            Some(Ok(bytes)) => Some(bytes),
            None => None,
        };
        let end = view.offset().checked_add(view.length());
        bytes
            .zip(end)
            .and_then(|(bytes, end)| bytes.get(view.offset()..end))
            .ok_or_else(|| {
                let message = format!(
                    "{what}: bufferViews[{}] ends beyond its buffer",
                    view.index()
                );
                self.error(ErrorKind::Mesh, message)
            })
    }
}
