//! What dialogs have in common, in English.

english_texts! { common:
    // buttons and words of dialogs
    Ok: "OK";
    Cancel: "Cancel";
    Close: "Close";
    Apply: "Apply";
    Add: "Add";
    Delete: "Delete";
    Retry: "Try again";
    On: "On";
    Off: "Off";
    Show: "Show";
    Hide: "Hide";
    Copy: "Copy";
    Reading: "Reading…";
    Processing: "Processing…";
    Cause: "Cause";
    Remedy: "Remedy";
    Detail: "Technical detail";
    Controllers: "Controllers";

    // confirmation
    ConfirmStops: "The OPC UA server is stopped for the change, and started again if it was running. Connected clients are cut off.";
    ConfirmStop: "The OPC UA server is stopped. Connected clients are cut off.";
    ConfirmReplaces: "The certificate of this type in the controller is replaced, and the server uses the new one. Clients have to trust it.";
    ConfirmChangesCertificate: "The server shows another certificate to its clients. Clients have to trust it.";
    ConfirmInvalidatesCaSigned: "On firmware before 8.0.0 the present CA-signed certificate becomes invalid at once: a server that uses it stops, connected clients are cut off, and it stays stopped until another certificate is imported or selected. Firmware 8.0.0 and later goes on using it until the new one is imported.";
    ConfirmReplacesRequest: "The CSR in the controller and its key are replaced by those of the backup. If the backup holds no certificate for them, the present CA-signed certificate becomes invalid at once, and a server that uses it stops.";
    ConfirmChangesEndpoints: "Clients reach the server only by the port, security policies and user tokens that are set here.";
    ConfirmOverwritesExport: "A settings export of the same name in the workspace is overwritten.";
    ConfirmReplacesSettings: "Settings and users in the controller are replaced by those of the file, and so are the activation keys if it holds any.";
    ConfirmDisturbsNobody: "The OPC UA server goes on running. Nobody is disconnected.";
    ConfirmDisconnectsClients: "Clients that are not trusted any more are disconnected at once. The OPC UA server goes on running.";
    ConfirmMovesFiles: "Files of a former certificate or CSR on this computer, and their keys, are kept: they are moved into a folder named after their date.";
    ConfirmDeletesLog: "The server log in the controller is deleted.";

    // processing
    StateWaiting: "Waiting";
    StateDone: "Done";
    StateFailed: "Failed";
    StateNotStarted: "Not started";
    StepConnect: "Connecting";
    StepRead: "Reading";
    StepVerify: "Verifying";
    StepMakeKey: "Making key";
    StepSign: "Signing";
    StepApply: "Applying";
    StepSaveBackup: "Saving files";
    Completed: "Completed";
    Stopped: "Stopped";
    CancelAsk: "Stop after the step in hand? What is done stays done.";
    CancelYes: "Stop";
    CancelNo: "Go on";
    Stopping: "Stopping after the step in hand…";

    // closing the window while work goes on
    CloseTitle: "Close the window?";
    CloseWarning: "Controllers or files are being changed. A change that is cut off can leave a controller without a usable certificate.";
    CloseOtherWork: "Files are still being written";
    CloseFinish: "Finish, then close";
    CloseStop: "Stop after this step, then close";
    CloseStay: "Stay open";
    CloseFinishing: "The window closes when all controllers are done. If one fails, the window stays open and shows why.";
    CloseStopping: "The window closes when the step in hand has ended.";
}
