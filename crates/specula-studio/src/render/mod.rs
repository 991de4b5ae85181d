//! Progressive renders: sessions that stay open between requests.

mod advance;
mod catalogue;
mod changes;
mod compare;
mod export;
mod gpu;
mod materials;
mod pick;
mod scenes;
mod session;
mod view;

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use serde::Deserialize;
use serde_json::{Map, Value, json};

use crate::request::fields;
use crate::{Answer, AskError, clock};
use catalogue::Catalogue;
pub use catalogue::{GivenScene, SceneFrom};
use session::Session;

/// Renders that are open at once: each keeps its picture's sums, at most 500 MB.
const MOST_SESSIONS: usize = 8;

/// Seconds after which a render that nobody asked for gives way to another; pages ask each 20 s.
const ABANDONED: f64 = 30.0;

/// The open renders, and the scenes that can be rendered.
#[derive(Debug, Default)]
pub(crate) struct Renders {
    catalogue: Mutex<Catalogue>,
    sessions: Mutex<Sessions>,
}

#[derive(Debug, Default)]
struct Sessions {
    open: BTreeMap<u64, Open>,
    /// Of the session that was opened last.
    last: u64,
}

/// An open render.
#[derive(Debug)]
struct Open {
    session: Arc<Mutex<Session>>,
    /// When it was asked for last, by [`clock`](crate::clock).
    used: f64,
}

impl Open {
    /// Whether it was not asked for in so many seconds, and is not answering.
    fn is_idle(&self, now: f64, seconds: f64) -> bool {
        now - self.used >= seconds && Arc::strong_count(&self.session) == 1
    }
}

impl Sessions {
    /// Closes the render that was not asked for longest, if its page has gone: pages ask for those that rest.
    fn close_abandoned(&mut self) {
        let now = clock::seconds();
        let idle = self
            .open
            .iter()
            .filter(|(_, open)| open.is_idle(now, ABANDONED));
        let longest = idle.min_by(|(_, a), (_, b)| a.used.total_cmp(&b.used));
        if let Some(id) = longest.map(|(&id, _)| id) {
            self.open.remove(&id);
        }
    }
}

/// A request about a session and nothing else.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct OfSession {
    session: u64,
}

impl Renders {
    /// Answers `render.{what}`.
    pub(crate) fn answer(
        &self,
        what: &str,
        request: Map<String, Value>,
    ) -> Result<Answer, AskError> {
        match what {
            "scenes" => {
                let _: Nothing = fields(request)?;
                Ok(Answer::new(locked(&self.catalogue).list()))
            }
            "open" => self.open(fields(request)?),
            "close" => {
                let OfSession { session } = fields(request)?;
                let closed = locked(&self.sessions).open.remove(&session);
                closed
                    .map(|_| Answer::new(json!({})))
                    .ok_or_else(|| gone(session))
            }
            "advance" => {
                let asked: advance::Advance = fields(request)?;
                self.with(asked.session, |session| session.advance(&asked))
            }
            "change" => {
                let asked: session::Change = fields(request)?;
                let id = asked.session;
                self.with(id, |session| session.change(id, asked))
            }
            "pick" => {
                let asked: pick::Pick = fields(request)?;
                self.with(asked.session, |session| session.pick(&asked))
            }
            "compare" => {
                let asked: compare::Compare = fields(request)?;
                // One after the other: two that are compared the other way round at once must not wait for each other.
                let test = self.with(asked.session, |session| session.picture())?;
                let reference = self.with(asked.reference, |session| session.picture())?;
                compare::answer(&reference, &test)
            }
            "gpu" => {
                let OfSession { session } = fields(request)?;
                self.with(session, |session| session.gpu())
            }
            "save" => {
                let asked: export::Save = fields(request)?;
                self.with(asked.session, |session| session.save(asked.format))
            }
            "scene" => {
                let asked: export::Export = fields(request)?;
                self.with(asked.session, |session| session.export(asked.format))
            }
            _ => Err(AskError::unknown(&format!("render.{what}"))),
        }
    }

    /// The scenes that can be opened.
    pub(crate) fn catalogue(&self) -> MutexGuard<'_, Catalogue> {
        locked(&self.catalogue)
    }

    fn open(&self, asked: session::Open) -> Result<Answer, AskError> {
        let has_room = |sessions: &mut Sessions| {
            if sessions.open.len() >= MOST_SESSIONS {
                sessions.close_abandoned();
            }
            match sessions.open.len() < MOST_SESSIONS {
                true => Ok(()),
                false => Err(AskError::new(format!(
                    "{MOST_SESSIONS} renders are open, and no more can be: close another page that renders"
                ))),
            }
        };
        has_room(&mut locked(&self.sessions))?;
        let scene = locked(&self.catalogue).scene(&asked.scene)?;
        let session = Session::open(scene, asked)?;
        let mut sessions = locked(&self.sessions);
        // Others may have been opened meanwhile.
        has_room(&mut sessions)?;
        sessions.last += 1;
        let id = sessions.last;
        let answer = Answer::new(session.described(id));
        let session = Arc::new(Mutex::new(session));
        let used = clock::seconds();
        sessions.open.insert(id, Open { session, used });
        Ok(answer)
    }

    /// Does something with a session; requests to others are answered meanwhile.
    fn with<T>(
        &self,
        session: u64,
        act: impl FnOnce(&mut Session) -> Result<T, AskError>,
    ) -> Result<T, AskError> {
        let found = {
            let mut sessions = locked(&self.sessions);
            let open = sessions
                .open
                .get_mut(&session)
                .ok_or_else(|| gone(session))?;
            open.used = clock::seconds();
            Arc::clone(&open.session)
        };
        let answer = act(&mut locked(&found));
        if let Some(open) = locked(&self.sessions).open.get_mut(&session) {
            open.used = clock::seconds();
        }
        answer
    }

    /// Closes what has not been asked for in so many seconds; returns how many.
    pub(crate) fn close_idle(&self, seconds: f64) -> usize {
        let mut sessions = locked(&self.sessions);
        let before = sessions.open.len();
        let now = clock::seconds();
        sessions.open.retain(|_, open| !open.is_idle(now, seconds));
        before - sessions.open.len()
    }
}

/// A request without fields.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Nothing {}

fn gone(session: u64) -> AskError {
    AskError::new(format!("session: no render {session} is open"))
}

fn locked<T>(what: &Mutex<T>) -> MutexGuard<'_, T> {
    what.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn open(renders: &Renders) -> Result<Answer, AskError> {
        let asked = json!({"scene": "ball", "width": 8, "height": 8});
        renders.answer("open", asked.as_object().cloned().unwrap_or_default())
    }

    #[test]
    fn a_render_whose_page_has_gone_gives_way() {
        let renders = Renders::default();
        for _ in 0..MOST_SESSIONS {
            open(&renders).unwrap();
        }
        assert!(open(&renders).is_err());
        let back = |id, seconds| {
            let mut sessions = locked(&renders.sessions);
            sessions.open.get_mut(&id).unwrap().used -= seconds;
        };
        back(2, ABANDONED + 1.0);
        back(5, ABANDONED + 2.0);
        // One that is answering stays, however long it takes.
        back(7, ABANDONED + 3.0);
        let answering = Arc::clone(&locked(&renders.sessions).open[&7].session);
        open(&renders).unwrap();
        drop(answering);
        let ids: Vec<u64> = locked(&renders.sessions).open.keys().copied().collect();
        assert_eq!(ids, [1, 2, 3, 4, 6, 7, 8, 9]);
    }
}
