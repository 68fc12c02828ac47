//! The message loop: one message after the other, diagnostics when none waits.

use std::collections::VecDeque;
use std::io::{self, BufReader, Read, Write};
use std::sync::mpsc::{Receiver, TryRecvError, sync_channel};
use std::thread;

use gen_lsp_types::{DidChangeTextDocumentParams, DidCloseTextDocumentParams, DidOpenTextDocumentParams};
use lsp_server::{ErrorCode, Message, Notification, Request, RequestId, Response, ResponseError};
use serde::de::DeserializeOwned;
use serde_json::{Value, json};

use super::capabilities::{Greeting, greeting};
use super::documents::Document;
use super::frames::{self, Frame};
use super::paths;
use super::publish::Published;
use super::requests::{Refused, answer, written};
use super::workspace::Workspace;
use crate::lang::World;

/// Messages that are read ahead, so that a request can be taken back before its turn.
const READ_AHEAD: usize = 1_024;

/// Serves one client until it leaves; says whether it did so as agreed: `shutdown`, then
/// `exit`. Files that are not open are read from `disk`.
///
/// # Errors
/// The output cannot be written.
pub fn serve(input: impl Read + Send + 'static, output: impl Write, disk: Box<dyn World>) -> io::Result<bool> {
    let (sender, receiver) = sync_channel(READ_AHEAD);
    thread::spawn(move || {
        let mut input = BufReader::new(input);
        while let Ok(Some(frame)) = frames::read(&mut input) {
            if sender.send(frame).is_err() {
                return;
            }
        }
    });
    let mut server = Server {
        output,
        waiting: VecDeque::new(),
        state: State::New(disk),
    };
    server.run(&receiver)
}

struct Server<W> {
    output: W,
    waiting: VecDeque<Message>,
    state: State,
}

enum State {
    /// With the files that documents are on.
    New(Box<dyn World>),
    Serving(Box<Serving>),
    /// `shutdown` came.
    Done,
}

/// What is known while a client is served.
struct Serving {
    greeting: Greeting,
    workspace: Workspace,
    published: Published,
}

impl<W: Write> Server<W> {
    fn run(&mut self, receiver: &Receiver<Frame>) -> io::Result<bool> {
        loop {
            let open = self.read_ahead(receiver);
            let Some(message) = self.waiting.pop_front() else {
                if self.publish()? {
                    continue;
                }
                match receiver.recv() {
                    Ok(frame) if open => self.arrived(frame),
                    _ => return Ok(false),
                }
                continue;
            };
            if matches!(&message, Message::Notification(n) if n.method == "exit") {
                return Ok(matches!(self.state, State::Done));
            }
            self.message(message)?;
        }
    }

    /// Takes over what has arrived; says whether more can.
    fn read_ahead(&mut self, receiver: &Receiver<Frame>) -> bool {
        while self.waiting.len() < READ_AHEAD {
            match receiver.try_recv() {
                Ok(frame) => self.arrived(frame),
                Err(TryRecvError::Empty) => return true,
                Err(TryRecvError::Disconnected) => return false,
            }
        }
        true
    }

    fn arrived(&mut self, frame: Frame) {
        match frame {
            Frame::Message(message) => self.waiting.push_back(*message),
            Frame::Malformed(why) => log(&format!("a message was passed over: {why}")),
        }
    }

    fn message(&mut self, message: Message) -> io::Result<()> {
        match message {
            Message::Request(request) => {
                let id = request.id.clone();
                let answer = match self.is_taken_back(&id) {
                    true => Err(Refused::new(ErrorCode::RequestCanceled, "taken back")),
                    false => self.request(request),
                };
                self.respond(id, answer)
            }
            Message::Notification(notification) => {
                self.notification(notification);
                Ok(())
            }
            // The server asks nothing.
            Message::Response(_) => Ok(()),
        }
    }

    /// Whether the client already cancelled a request that waited for its turn.
    fn is_taken_back(&self, id: &RequestId) -> bool {
        self.waiting.iter().any(|message| match message {
            Message::Notification(n) if n.method == "$/cancelRequest" => {
                n.params.get("id").is_some_and(|taken| json!(id) == *taken)
            }
            _ => false,
        })
    }

    fn request(&mut self, request: Request) -> Result<Value, Refused> {
        match (&mut self.state, request.method.as_str()) {
            (State::New(_), "initialize") => self.begin(&request.params),
            (State::New(_), _) => Err(Refused::new(
                ErrorCode::ServerNotInitialized,
                "`initialize` comes first",
            )),
            (_, "initialize") => Err(Refused::new(ErrorCode::InvalidRequest, "`initialize` came before")),
            (State::Done, _) => Err(Refused::new(ErrorCode::InvalidRequest, "`shutdown` came before")),
            (State::Serving(_), "shutdown") => {
                self.state = State::Done;
                Ok(Value::Null)
            }
            (State::Serving(serving), method) => {
                answer(&mut serving.workspace, &serving.greeting, method, &request.params)
            }
        }
    }

    fn begin(&mut self, params: &Value) -> Result<Value, Refused> {
        let asked = Greeting::read(params);
        let answer = written(greeting(&asked));
        let state = std::mem::replace(&mut self.state, State::Done);
        if let State::New(disk) = state {
            self.state = State::Serving(Box::new(Serving {
                workspace: Workspace::new(disk, asked.encoding, asked.roots.clone()),
                greeting: asked,
                published: Published::default(),
            }));
        }
        answer
    }

    fn notification(&mut self, notification: Notification) {
        let State::Serving(serving) = &mut self.state else {
            return;
        };
        let params = notification.params;
        match notification.method.as_str() {
            "textDocument/didOpen" => with(params, |p| serving.opened(p)),
            "textDocument/didChange" => with(params, |p| serving.changed(p)),
            "textDocument/didClose" => with(params, |p| serving.closed(&p)),
            "workspace/didChangeWatchedFiles" | "textDocument/didSave" => serving.workspace.all_changed(),
            _ => {}
        }
    }

    /// Publishes what is new about one program; says whether there was one.
    fn publish(&mut self) -> io::Result<bool> {
        let State::Serving(serving) = &mut self.state else {
            return Ok(false);
        };
        let Some(messages) = serving.published.next(&mut serving.workspace) else {
            return Ok(false);
        };
        for message in messages {
            let params = serde_json::to_value(message)?;
            let notification = Notification {
                method: "textDocument/publishDiagnostics".to_owned(),
                params,
            };
            Message::from(notification).write(&mut self.output)?;
        }
        Ok(true)
    }

    fn respond(&mut self, id: RequestId, answer: Result<Value, Refused>) -> io::Result<()> {
        let response_result = answer.map_err(|refused| ResponseError {
            code: refused.code as i32,
            message: refused.message,
            data: None,
        });
        Message::from(Response { id, response_result }).write(&mut self.output)
    }
}

impl Serving {
    fn opened(&mut self, params: DidOpenTextDocumentParams) {
        let document = params.text_document;
        let path = paths::path(&document.uri);
        let open = Document {
            uri: document.uri,
            version: document.version,
            text: document.text,
        };
        self.workspace.documents.open.insert(path, open);
        self.workspace.all_changed();
    }

    fn changed(&mut self, params: DidChangeTextDocumentParams) {
        let path = paths::path(&params.text_document.text_document_identifier.uri);
        let Some(document) = self.workspace.documents.open.get_mut(&path) else {
            return;
        };
        document.version = params.text_document.version;
        document.change(params.content_changes, self.workspace.encoding);
        self.workspace.changed(&path);
    }

    fn closed(&mut self, params: &DidCloseTextDocumentParams) {
        let path = paths::path(&params.text_document.uri);
        if self.workspace.documents.open.remove(&path).is_some() {
            self.workspace.all_changed();
            self.workspace.unpublished.insert(path);
        }
    }
}

/// Hands parameters on; malformed ones are passed over.
fn with<P: DeserializeOwned>(params: Value, take: impl FnOnce(P)) {
    match serde_json::from_value(params) {
        Ok(params) => take(params),
        Err(error) => log(&format!("a notification was passed over: {error}")),
    }
}

/// Standard output is the protocol's.
fn log(text: &str) {
    let _ = writeln!(io::stderr(), "vpl lsp: {text}");
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lang::Memory;

    fn request(id: i32, method: &str) -> Message {
        Request::new(id.into(), method.to_owned(), json!({})).into()
    }

    #[test]
    fn a_request_can_be_taken_back_before_its_turn() {
        let cancel = Notification::new("$/cancelRequest".to_owned(), json!({ "id": 2 }));
        let mut server = Server {
            output: Vec::new(),
            waiting: [cancel.into(), request(3, "no/such")].into(),
            state: State::New(Box::new(Memory::default())),
        };
        server.message(request(1, "initialize")).unwrap();
        server.message(request(2, "no/such")).unwrap();
        server.message(request(3, "no/such")).unwrap();
        let said = String::from_utf8(server.output).unwrap();
        assert!(said.contains("-32800") && said.contains("\"id\":2"), "{said}");
        assert_eq!(said.matches("-32601").count(), 1, "{said}");
    }
}
