use std::sync::Arc;

use parking_lot::Mutex;

use super::request::LoggedExchange;
use crate::model::clock;
use crate::remote::client::{Observed, Observer};

/// Collects what goes over the line until it is asked for it.
#[derive(Debug, Clone, Default)]
pub(super) struct ExchangeTap(Arc<Mutex<Collected>>);

#[derive(Debug, Default)]
struct Collected {
    /// What goes over the line now belongs to a command that was asked for.
    is_asked: bool,
    exchanges: Vec<LoggedExchange>,
}

impl ExchangeTap {
    /// Tells of each message as it goes over the line.
    pub fn observer(&self) -> Observer {
        let collected = Arc::clone(&self.0);
        Arc::new(move |message: &Observed| {
            let mut collected = collected.lock();
            let is_polling = !collected.is_asked;
            collected.exchanges.push(LoggedExchange { at: clock::now(), is_polling, message: message.clone() });
        })
    }

    /// From now on what goes over the line belongs to a command that was asked for, or to a cycle again.
    pub fn set_asked(&self, is_asked: bool) {
        self.0.lock().is_asked = is_asked;
    }

    /// Everything that was collected since the last call.
    pub fn take(&self) -> Vec<LoggedExchange> {
        std::mem::take(&mut self.0.lock().exchanges)
    }
}
