use std::sync::Arc;

use tokio::task::spawn_blocking;

use super::error::{ControllerError, ServerStartError};
use super::server_slot::{ServerSlot, opcua_config, trust_lists};
use super::{Controller, ServerState};
use crate::model::{Changed, DisconnectedClient, RevisionToken};
use crate::virtual_controller::cell::SpelDeclarations;
use crate::virtual_controller::faults::DropPoint;
use crate::virtual_controller::opcua::{CertificateClock, OpcUaConfig, OpcUaServer, ServerEvent, ServerEvents};
use crate::virtual_controller::server_log::ServerLog;
use crate::virtual_controller::state::{ControllerState, OperatingContext};
use crate::virtual_controller::{memory, project_file};

/// What a change means for a running OPC UA server.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in super::super) enum Effect {
    /// It has to be stopped and started with the new configuration.
    Restart,
    /// It takes over the trust lists as it runs, and ends connections that would not be let in any more.
    Trust,
    /// Its certificate may be gone. Without one it stops for good; otherwise it does not notice.
    CertificateLost,
    /// It does not notice.
    Nothing,
}

/// A change that is in force.
pub(super) struct AppliedChange<T> {
    pub changed: Changed,
    pub value: T,
    /// Whose connections were ended.
    pub cut: Vec<DisconnectedClient>,
}

/// How a change, a start or a stop did not succeed.
#[derive(Debug)]
pub(in super::super) enum ChangeFailure {
    Error(ControllerError),
    /// A fault switch asks for the connection to be lost here.
    Dropped,
}

impl<E> From<E> for ChangeFailure
where
    ControllerError: From<E>,
{
    fn from(error: E) -> Self {
        Self::Error(error.into())
    }
}

const RESTORE_ATTEMPTS: u32 = 3;
const RESTORE_PAUSE: std::time::Duration = std::time::Duration::from_millis(100);

impl Controller {
    /// Makes a change, whole or not at all, even if the one who asked has gone: copy the state, edit the copy, write
    /// it beside the one in force, give the server the new configuration, and only then let the copy take its place.
    /// If a step fails, the ones before it are undone.
    pub(in super::super) async fn change<T: Send + 'static, E: Send + 'static>(
        self: &Arc<Self>,
        revision: RevisionToken,
        effect: Effect,
        edit: impl FnOnce(&mut ControllerState, &OperatingContext) -> Result<T, E> + Send + 'static,
    ) -> Result<(Changed, T), ChangeFailure>
    where
        ControllerError: From<E>,
    {
        let this = Arc::clone(self);
        finished(tokio::spawn(async move { this.change_now(revision, effect, edit).await }).await)
    }

    pub(in super::super) async fn start_server(self: &Arc<Self>) -> Result<Changed, ChangeFailure> {
        let this = Arc::clone(self);
        finished(
            tokio::spawn(async move {
                this.faults.admit_change()?;
                this.start_server_now().await?;
                Ok(this.changed())
            })
            .await,
        )
    }

    pub(in super::super) async fn stop_server(self: &Arc<Self>) -> Result<Changed, ChangeFailure> {
        let this = Arc::clone(self);
        finished(
            tokio::spawn(async move {
                this.faults.admit_change()?;
                let mut slot = this.server.lock().await;
                slot.admit()?;
                slot.stop().await;
                memory::give_back();
                *this.server_state.lock() = ServerState::Stopped;
                Ok(this.changed())
            })
            .await,
        )
    }

    /// As [`Controller::change`], with a new server log: the old one is deleted, or kept if the change fails.
    pub(in super::super) async fn change_with_new_log<T: Send + 'static, E: Send + 'static>(
        self: &Arc<Self>,
        revision: RevisionToken,
        effect: Effect,
        edit: impl FnOnce(&mut ControllerState, &OperatingContext) -> Result<T, E> + Send + 'static,
    ) -> Result<(Changed, T), ChangeFailure>
    where
        ControllerError: From<E>,
    {
        let this = Arc::clone(self);
        let change = async move {
            let mut slot = this.server.lock().await;
            // Before the change: a full log keeps the server from starting.
            this.with_log(ServerLog::put_aside).await?;
            match this.apply(&mut slot, revision, effect, edit).await {
                Ok(AppliedChange { changed, value, .. }) => {
                    drop(slot);
                    if let Err(error) = this.with_log(ServerLog::delete_aside).await {
                        tracing::warn!(%error, "the old server log was not deleted");
                    }
                    this.answer()?;
                    // The status may be better without the full log.
                    Ok((Changed { status: this.changed().status, ..changed }, value))
                }
                Err(outcome) => {
                    if let Err(error) = this.with_log(ServerLog::put_back).await {
                        tracing::warn!(%error, "the server log was not put back");
                    }
                    Err(outcome)
                }
            }
        };
        finished(tokio::spawn(change).await)
    }

    async fn with_log(&self, work: fn(&ServerLog) -> std::io::Result<()>) -> Result<(), ControllerError> {
        let log = Arc::clone(&self.log);
        let done = spawn_blocking(move || work(&log)).await.map_err(std::io::Error::other).flatten();
        done.map_err(ControllerError::Log)
    }

    async fn change_now<T: Send + 'static, E: Send + 'static>(
        self: Arc<Self>,
        revision: RevisionToken,
        effect: Effect,
        edit: impl FnOnce(&mut ControllerState, &OperatingContext) -> Result<T, E> + Send + 'static,
    ) -> Result<(Changed, T), ChangeFailure>
    where
        ControllerError: From<E>,
    {
        let mut slot = self.server.lock().await;
        let AppliedChange { changed, value, .. } = self.apply(&mut slot, revision, effect, edit).await?;
        drop(slot);
        self.answer()?;
        Ok((changed, value))
    }

    /// Whether the answer to a change that was applied reaches who asked for it.
    pub(super) fn answer(&self) -> Result<(), ChangeFailure> {
        if self.faults.take_drop(DropPoint::AfterApply) { Err(ChangeFailure::Dropped) } else { Ok(()) }
    }

    pub(super) fn check_revision(&self, base: RevisionToken) -> Result<(), ControllerError> {
        let now = RevisionToken::new(self.state().revision);
        if base == now { Ok(()) } else { Err(ControllerError::ChangedMeanwhile { base, now }) }
    }

    /// Applies a change. The caller holds the lock of the server.
    pub(super) async fn apply<T: Send + 'static, E: Send + 'static>(
        &self,
        slot: &mut ServerSlot,
        revision: RevisionToken,
        effect: Effect,
        edit: impl FnOnce(&mut ControllerState, &OperatingContext) -> Result<T, E> + Send + 'static,
    ) -> Result<AppliedChange<T>, ChangeFailure>
    where
        ControllerError: From<E>,
    {
        slot.admit()?;
        self.faults.admit_change()?;
        self.check_revision(revision)?;
        let effect = if slot.is_running() { effect } else { Effect::Nothing };
        let old = self.state();
        let (store, context, copy) = (Arc::clone(&self.store), self.operating_context(), ControllerState::clone(&old));
        let (new, value, lists, staged) = blocking(move || {
            let mut state = copy;
            let value = edit(&mut state, &context)?;
            state.revision += 1;
            state.check()?;
            let lists = if effect == Effect::Trust {
                Some(trust_lists(&state).map_err(ControllerError::TrustLists)?)
            } else {
                None
            };
            let staged = store.stage(&state)?;
            Ok::<_, ControllerError>((state, value, lists, staged))
        })
        .await?;
        if self.faults.take_drop(DropPoint::BeforeApply) {
            return Err(ChangeFailure::Dropped);
        }

        self.take_effect(slot, effect, &old, &new).await?;
        if let Err(error) = blocking(move || Ok(staged.commit()?)).await {
            match effect {
                Effect::Restart => {
                    slot.stop().await;
                    self.restore(slot, &old).await;
                }
                Effect::CertificateLost if !slot.is_running() => self.restore(slot, &old).await,
                Effect::CertificateLost | Effect::Trust | Effect::Nothing => {}
            }
            return Err(error.into());
        }
        *self.state.write() = Arc::new(new);
        if effect == Effect::CertificateLost && !slot.is_running() {
            *self.server_state.lock() = ServerState::Stopped;
        }
        // Last, and it cannot fail: a connection that is ended cannot be given back.
        let cut = match lists {
            Some(lists) => slot.trust(lists).await,
            None => Vec::new(),
        };
        Ok(AppliedChange { changed: self.changed(), value, cut })
    }

    pub(in super::super) async fn start_server_now(&self) -> Result<(), ControllerError> {
        let mut slot = self.server.lock().await;
        slot.admit()?;
        if slot.is_running() {
            return Ok(());
        }
        // One that died by itself.
        slot.stop().await;
        match self.start_with(&self.state()).await {
            Ok(server) => {
                slot.server = Some(server);
                *self.server_state.lock() = ServerState::Running;
                Ok(())
            }
            Err(error) => {
                self.failed(error.code());
                Err(error.into())
            }
        }
    }

    /// Gives the running server the new configuration; if that fails, the old one again.
    async fn take_effect(
        &self,
        slot: &mut ServerSlot,
        effect: Effect,
        old: &ControllerState,
        new: &ControllerState,
    ) -> Result<(), ServerStartError> {
        match effect {
            Effect::Restart => self.restart(slot, old, new).await,
            Effect::CertificateLost => {
                if new.selected_certificate().is_none() {
                    slot.stop().await;
                }
                Ok(())
            }
            // Once the change is in force.
            Effect::Trust | Effect::Nothing => Ok(()),
        }
    }

    async fn restart(
        &self,
        slot: &mut ServerSlot,
        old: &ControllerState,
        new: &ControllerState,
    ) -> Result<(), ServerStartError> {
        // A configuration that cannot run is refused before anything is stopped.
        new.check_start(&self.operating_context())?;
        slot.stop().await;
        match self.start_with(new).await {
            Ok(server) => {
                slot.server = Some(server);
                Ok(())
            }
            Err(error) => {
                self.restore(slot, old).await;
                Err(error)
            }
        }
    }

    /// Puts back the server that ran until a moment ago. Should even that fail, the status says so.
    async fn restore(&self, slot: &mut ServerSlot, old: &ControllerState) {
        for attempt in 1..=RESTORE_ATTEMPTS {
            match self.run(old).await {
                Ok(server) => {
                    slot.server = Some(server);
                    return;
                }
                Err(error) if attempt == RESTORE_ATTEMPTS => {
                    tracing::error!(serial = %old.identity.serial, %error, "the OPC UA server could not be put back");
                    self.failed(error.code());
                }
                Err(_) => tokio::time::sleep(RESTORE_PAUSE).await,
            }
        }
    }

    /// As [`Controller::run`], unless the fault switch fails the start.
    async fn start_with(&self, state: &ControllerState) -> Result<OpcUaServer, ServerStartError> {
        if self.faults.get().server_error { Err(ServerStartError::FaultSwitch) } else { self.run(state).await }
    }

    async fn run(&self, state: &ControllerState) -> Result<OpcUaServer, ServerStartError> {
        let mut config = self.config(state).await?;
        config.refusals = Some(Arc::clone(&self.rejected) as _);
        let faults = self.faults.clone();
        config.clock = CertificateClock::new(move || faults.now());
        config.trust_policy = self.admission.trust_policy();
        config.detailed_status = self.admission.detailed_status;
        if state.settings.server_log {
            if self.log.is_full() {
                return Err(ServerStartError::LogFull);
            }
            let log = Arc::clone(&self.log);
            config.events = ServerEvents::new(move |event| log.write(event));
        }
        self.declare_variables(&config.events).await;
        Ok(OpcUaServer::start(config).await?)
    }

    /// Takes the SPEL variables that the project declares now (manual 4.2.2). Variables that cannot be shown are
    /// reported as events.
    async fn declare_variables(&self, events: &ServerEvents) {
        let folder = self.folder.clone();
        let loaded = spawn_blocking(move || project_file::load(&folder)).await.map_err(std::io::Error::other);
        match loaded.flatten() {
            Ok(SpelDeclarations { variables, findings }) => {
                for finding in &findings {
                    events.tell(ServerEvent::VariableNotShown { finding });
                }
                self.cell.declare_variables(variables);
            }
            Err(error) => events.tell(ServerEvent::VariablesUnreadable { reason: &error.to_string() }),
        }
    }

    /// Parses what may be megabytes of CRLs: off the async threads.
    async fn config(&self, state: &ControllerState) -> Result<OpcUaConfig, ServerStartError> {
        let (state, context, folder) = (state.clone(), self.operating_context(), self.folder.clone());
        let cell = self.cell.clone();
        spawn_blocking(move || opcua_config(&state, &context, cell, &folder)).await?
    }

    pub(in super::super) async fn switch_off(&self) {
        let mut slot = self.server.lock().await;
        slot.off = true;
        if slot.server.is_some() {
            slot.stop().await;
            memory::give_back();
        }
        *self.server_state.lock() = ServerState::Stopped;
    }
}

pub(super) fn finished<T>(
    joined: Result<Result<T, ChangeFailure>, tokio::task::JoinError>,
) -> Result<T, ChangeFailure> {
    joined.unwrap_or_else(|error| Err(error.into()))
}

/// Runs on a thread that may wait. A panic there is the controller's mistake, not the end of it.
async fn blocking<T: Send + 'static>(
    work: impl FnOnce() -> Result<T, ControllerError> + Send + 'static,
) -> Result<T, ControllerError> {
    spawn_blocking(work).await?
}
