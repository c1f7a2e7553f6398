//! Closing the window while work goes on.

/// How far closing the window is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Closing {
    /// The dialog waits for a choice.
    Asking,
    /// The window closes when the running job has ended, unless a controller failed in it.
    Finishing,
    /// The job was told to stop after the step in hand; the window closes then.
    Stopping,
}

/// What is chosen about closing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CloseChoice {
    /// The window was to be closed while work goes on.
    Ask,
    /// Close when the job has ended.
    Finish,
    /// Close after the step in hand; controllers that were not begun are left out.
    Stop,
    /// Do not close.
    Stay,
}
