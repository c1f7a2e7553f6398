//! The fixed texts in English.
//!
//! Sentence case, no full stop after a single sentence, `…` on a button or menu entry that opens a dialog, no colon after
//! a label.

fixed_texts! {
    AppName: "OPC UA Configurator";

    // menus
    MenuController: "Controller";
    MenuCertificate: "Certificate";
    MenuServer: "Server settings";
    MenuOptions: "Options";
    MenuTools: "Tools";
    MenuHelp: "Help";
    MenuCreate: "Create and save";
    MenuClients: "Client certificates";

    // commands, and what they do
    AddController: "Add controller…";
    AddControllerTip: "Register a controller by its name, address and connection password";
    DeleteControllers: "Delete…";
    DeleteControllersTip: "Remove the ticked controllers from the list";
    ConnectionList: "Get connection list…";
    ConnectionListTip: "Register controllers from a connection list";
    ConfirmIdentity: "Confirm identity…";
    ConfirmIdentityTip: "Compare the fingerprint of the ticked controllers before anything is sent to them";
    Quit: "Quit";
    QuitTip: "Close the window";
    Start: "Start";
    StartTip: "Start the OPC UA server of the ticked controllers";
    Stop: "Stop";
    StopTip: "Stop the OPC UA server of the ticked controllers";
    GetInfo: "Get new information";
    GetInfoTip: "Read status, certificate and activation of the ticked controllers";
    BasicSettings: "Basic settings…";
    BasicSettingsTip: "Port, startup mode, security policies, user tokens and server log";
    Users: "Users…";
    UsersTip: "List, add and delete the users of the OPC UA server";
    Activation: "Activation…";
    ActivationTip: "Enter licence and activation keys";
    ExportSettings: "Export…";
    ExportSettingsTip: "Save the server settings to a file";
    ImportSettings: "Import…";
    ImportSettingsTip: "Take the server settings from a file";
    SelfSigned: "Self-signed…";
    SelfSignedTip: "Make a self-signed server certificate and install it";
    UserSpecified: "User specified…";
    UserSpecifiedTip: "Install a server certificate made elsewhere";
    CaSigned: "CA signed…";
    CaSignedTip: "Make a certificate signing request and import the signed certificate";
    ExportSelfSigned: "Export self-signed…";
    ExportSelfSignedTip: "Save the self-signed server certificate to a file";
    TypeSelect: "Type select…";
    TypeSelectTip: "Choose which of the installed server certificates is used";
    RestoreBackup: "Restore backup…";
    RestoreBackupTip: "Put a key and its certificate back into the controllers from a backup";
    ClientLists: "Client certificates…";
    ClientListsTip: "Trusted, rejected and issuers: which clients may connect";
    Crl: "CRL…";
    CrlTip: "Certificate revocation lists of the authorities that issued client certificates";
    Backup: "Backup…";
    BackupTip: "Keep copies of certificates in the workspace";
    Options: "Options…";
    OptionsTip: "Language, theme and controllers worked on at once";
    CertificateAuthority: "Certificate authority…";
    CertificateAuthorityTip: "Sign certificate requests with an authority of your own";
    Verify: "Verify";
    VerifyTip: "Connect to the OPC UA server as a client would, in every way it offers";
    Shortcuts: "Keyboard shortcuts";
    ShortcutsTip: "Every key this window knows";
    Licences: "Licences…";
    LicencesTip: "The licences of everything this program is made of";
    About: "About";
    AboutTip: "Version and licence";
    TickAll: "Tick all";
    TickAllTip: "Tick every controller shown";
    Search: "Search";
    SearchTip: "Search name, address, serial number and type";
    TryVirtual: "Try it with virtual controllers";
    TryVirtualTip: "Start a few simulated controllers on this computer and add them to the list";

    // why something is disabled
    WhyTick: "Tick at least one controller first";
    WhyActivationOption: "Firmware 8.0.0 and later is activated as a controller option";
    WhyConfirmed: "Every ticked controller is confirmed already";
    WhyUserOne: "For one controller at a time: tick only that one";
    WhyUserLegacy: "Only for firmware before 8.0.0";
    WhyEmpty: "The list is empty";
    WhyVirtual: "Not available in this build";

    // table
    ColumnName: "Name";
    ColumnType: "Controller type";
    ColumnAddress: "IP address";
    ColumnSerial: "Serial number";
    ColumnStatus: "Status";
    ColumnExpiry: "Expiry";
    ColumnCertificate: "Certificate type";
    ColumnActivation: "Activation";
    ColumnRetrieved: "Retrieved at";
    NotConfirmed: "Not confirmed";
    NotConfirmedTip: "Nothing is sent to it until its fingerprint was compared: choose Get new information";
    StatusRun: "Run";
    StatusStop: "Stop";
    StatusError: "Error";
    Expired: "expired";
    ExpiresSoon: "expires soon";
    TypeSelfSigned: "Self-signed";
    TypeUserSpecified: "User specified";
    TypeCaSigned: "CA signed";
    Yes: "Yes";
    No: "No";
    NotRead: "Not read yet";
    NothingFound: "No controller matches the search";
    ClearSearch: "Clear search";

    // welcome
    WelcomeTitle: "No controllers yet";
    WelcomeText: "Add the controllers whose OPC UA servers you want to set up";
    WelcomeAdd: "Add a controller";
    WelcomeVirtualText: "No robot at hand? Simulated controllers run on this computer and behave like real ones";
    StartingVirtual: "Starting virtual controllers…";

    // dialogs: buttons and common words
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

    // add controller
    AddControllerTitle: "Add controller";
    Password: "Connection password";
    PasswordHint: "Empty if none is set";
    AddressHint: "192.168.0.1 or host:port";
    NameRule: "1 to 32 characters";
    NameTaken: "Another controller already has this name";
    AddressTaken: "Another controller already has this address";
    AddressRule: "Enter an IP address or a host name, with or without a port";
    FingerprintTitle: "Is this your controller?";
    FingerprintText: "Compare this fingerprint with the one the controller shows. It is checked at every connection from now on, so nobody can pose as this controller. The password is sent only after you agree.";
    FingerprintLabel: "Fingerprint (SHA-256)";
    FingerprintLater: "Compare this fingerprint with the one the controller shows. It is checked at every connection from now on, so nobody can pose as this controller. Then enter its password.";
    FingerprintConfirm: "It matches, go on";
    LookingForController: "Reading the fingerprint of the controller…";
    Skip: "Skip";
    FingerprintMatches: "It matches, add";

    AddUnconfirmed: "Add without confirming its identity";
    AddUnconfirmedTip: "For a controller that is switched off. Nothing is sent to it until its fingerprint was compared; then its password is asked for.";

    // delete
    DeleteTitle: "Delete from the list";
    DeleteText: "They are removed from the list with their connection passwords. Nothing is changed in the controllers, and saved files stay.";

    DeleteVaultClosed: "The vault for passwords is closed: open it first, or their passwords stay in it.";

    // password
    PasswordTitle: "Connection password needed";
    PasswordText: "Enter the password for Ethernet connections that is set in these controllers";
    PasswordUse: "Use for these controllers";

    PasswordNotKept: "The password is known until this window is closed. A vault keeps it without a keyring, see the options.";

    // the vault for connection passwords
    PasswordsLabel: "Connection passwords";
    PasswordsKeyring: "Keyring of this computer";
    PasswordsVault: "Vault in the workspace";
    PasswordsNotKept: "Passwords are not kept";
    PasswordsNotKeptTip: "A password that was entered is known until this window is closed. Click to do something about it.";
    VaultOpen: "Open vault…";
    VaultClose: "Close vault";
    VaultChange: "Change passphrase…";
    VaultCreateTitle: "Create a vault for passwords";
    VaultCreateText: "The vault keeps connection passwords in the workspace, sealed under a passphrase. It is asked for once each time the program starts. Nobody can open the vault without it.";
    VaultCreateNow: "Create";
    VaultOpenTitle: "Open the vault for passwords";
    VaultOpenText: "The connection passwords are in the vault of this workspace. If it is not opened, they are asked for instead.";
    VaultOpenNow: "Open";
    VaultChangeTitle: "Change the passphrase of the vault";
    VaultChangeText: "Copies of the vault that were made before still open with the old passphrase.";
    VaultChangeNow: "Change";
    VaultNewPassphrase: "New passphrase";
    VaultPassphraseNeeded: "Enter the passphrase of the vault";
    VaultCreated: "The vault was created: connection passwords are kept in it";
    VaultOpened: "The vault is open";
    VaultPassphraseChanged: "The passphrase of the vault was changed";

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

    // buttons that agree to a confirmation
    ActSettings: "Change settings";
    ActSelfSigned: "Create certificate";
    ActActivate: "Activate";
    ActSelectType: "Switch certificate";
    ActCreateCsr: "Create CSR";
    ActImportSettings: "Replace settings";
    ActSignAndImport: "Sign and import";
    ActSendCrl: "Send CRL";
    ActMoveClients: "Move certificates";

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

    EnterPassword: "Enter password…";

    // basic settings
    SettingsTitle: "Basic settings";
    SettingsMany: "The same settings go to all ticked controllers. The fields start from the defaults.";
    Port: "Port";
    PortRule: "Enter a port from 1024 to 65535";
    PortUsed: "Another function of the controller uses this port";
    StartupMode: "Server startup mode";
    StartupAutoTip: "The server starts when the controller is switched on";
    StartupManualTip: "The server starts when somebody presses Start";
    SecurityPolicy: "Security policy";
    NotEncrypted: "not encrypted";
    Deprecated: "deprecated";
    PolicyRule: "Tick at least one security policy";
    TokenPolicy: "User token policy";
    TokenAnonymous: "Anonymous";
    TokenUserName: "User name and password";
    TokenRule: "Tick at least one user token policy";
    NoUsersWarning: "The controller has no users yet, so nobody can log in";
    ServerLog: "Server log";
    LogPassword: "Password for the log";
    LogPasswordTip: "199532 switches it on (manual 2.6.1)";
    LogWarning: "The server stops by itself when the log reaches its size limit";
    DeleteLog: "Delete log";

    // users
    UsersTitle: "Users";
    UsersNone: "No users yet";
    UserName: "User name";
    UserPassword: "Password";
    UserRule: "8 to 32 letters A–Z, a–z and digits";
    AddUser: "Add user…";
    AddUserTitle: "Add user";
    AddUserMany: "The user is added to all ticked controllers";
    DeleteUsers: "Delete users";
    UserExists: "A user of this name already exists";
    UsersFull: "A controller takes at most 10 users";
    TickUser: "Tick the users to delete first";

    // self-signed
    SelfSignedTitle: "Self-signed certificate";
    CommonName: "Common name";
    CommonNameEach: "Made per controller";
    CommonNameRule: "1 to 64 half-width characters";
    Country: "Country";
    CountryNone: "(none)";
    CountrySearch: "Search country";
    State: "State";
    Locality: "Locality";
    Organisation: "Organisation";
    HalfWidthRule: "Half-width printable characters only";
    LengthRule: "Too long";
    KeyLength: "Key length";
    KeyLengthOne: "Offered are the lengths every ticked security policy allows";
    KeyLengthMany: "Controllers whose security policies do not allow it refuse this length";
    Validity: "Validity (years)";
    Optional: "optional";

    // connection list
    ConnectionListTitle: "Get connection list";
    ConnectionListText: "A CSV file with the columns Name, Type and Address. Controllers on USB and simulated ones are left out.";
    Import: "Import";
    NothingToImport: "There is no new controller in the file";
    TickConnection: "Tick at least one controller to import";
    SeriesGuess: "The list does not say it. What the controller says of itself replaces it.";
    LinesLeftOut: "Left out";
    ImportText: "Nothing is sent to them until you have compared their fingerprints.";

    // activation
    ActivationTitle: "Activation";
    ActivationMany: "Keys for several controllers come from an activation file: a CSV file with a line per controller, its serial number, licence key and activation key";
    LicenceKey: "Licence key";
    ActivationKey: "Activation key";
    KeysRule: "Enter both keys completely";
    KeyComplete: "Complete";
    NoKeysInFile: "The file has keys for none of these controllers";
    KeysMissing: "Not in the file";
    KeysUnknown: "Not read yet, looked up when it is reached";
    LinesWithMistakes: "Lines that cannot be used";
    LinesUnused: "Lines of controllers that are not ticked";

    // files
    FileLabel: "File";
    FileHint: "Path of the file";
    FileRule: "Choose a file or type its path";
    ChooseFile: "Choose…";
    ChooseFileTitle: "Choose a file";
    ReadFile: "Read file";
    Browse: "Browse…";
    OpenFolder: "Open folder";

    // files dropped onto the window
    DropTitle: "Dropped files";
    DropChoose: "Use as";
    DropOpen: "Open";
    DropUnseen: "Drop them to see what they are";
    DropAsks: "Several dialogs take this; you choose after dropping";
    DropNothing: "Nothing here can be used";
    DropDialogOpen: "A dialog is open: close it first, then drop the files again";
    DropTooMany: "Too many files: drop at most 100 at once";
    DropOneFile: "One file at a time: drop only that one";
    WhySplitKey: "The file holds certificate and private key together: save them as two files, or as one .pfx";
    DropCrl: "Certificate revocation list (CRL)";
    DropAuthority: "Certificate authority";
    KindActivation: "Activation file";
    KindConnectionList: "Connection list";
    KindSettingsExport: "Settings export";
    KindCertificate: "Certificate";
    KindChain: "Several certificates (PEM)";
    KindBundle: "Collection of certificates or CRLs (PKCS#7 or PEM)";
    KindCsr: "Certificate signing request (CSR)";
    KindKey: "Private key";
    KindKeyAndCertificate: "Certificate and private key in one PEM file";
    KindPkcs12: "Certificate with encrypted key (PKCS#12)";

    // certificate files
    ExportSelfSignedTitle: "Export self-signed certificate";
    Export: "Export";
    FileFormat: "File format";
    GoesTo: "Goes to";
    SavedIn: "Saved in";
    ImportedFrom: "Imported from";
    MovedAside: "Former files were moved to";
    CaSignedTitle: "CA-signed certificate";
    CsrTitle: "Certificate signing request";
    CsrCard: "1. Create CSR";
    CsrText: "Makes a new key and its signing request. Send the file in this folder to your CA.";
    CreateCsr: "Create CSR…";
    CreateAndSave: "Create and save";
    ImportCard: "2. Import certificate";
    ImportFromFolder: "Put the certificate from the CA into this folder: exactly one .der file, named with letters, digits and underscores.";
    ImportTextMany: "Put the certificate from the CA into the folder of each controller: exactly one .der file, named with letters, digits and underscores.";
    CertificateFile: "Certificate file";
    KeyFile: "Key file";
    PfxFile: "File";
    FolderFileHint: "Empty: the one in the folder";
    Folder: "Folder";
    ImportAsk: "Import…";
    Checking: "Checking…";
    UserSpecifiedTitle: "User-specified certificate";
    UserKind: "Kind";
    UserKindPfx: "Certificate with encrypted key (.pfx)";
    UserKindPair: "Certificate and key (.der, .key)";
    UserFilePassword: "Password of the file";
    UserKeyPassword: "Password of the key";
    UserKeyPasswordHint: "Empty if it is not encrypted";
    UserFilesRule: "Give both files, or neither to use those in the folder";
    UserPathRule: "Give the file, or get new information first";
    ImportAnyway: "Import anyway";
    NoneToImport: "None of these can be imported";
    ImportRefused: "Not imported";
    FindingNone: "Nothing found that clients could complain about";
    Warning: "Warning";
    IssuerNotHere: "The next issuer is neither in the file nor in files beside it; clients need it to trust the controller";
    SerialFolder: "serial number";

    // backups of keys
    RestoreTitle: "Restore backup";
    RestoreText: "A key that was kept on this computer is put back into the controller, under the type it had.";
    RestoreKind: "Backup of";
    RestoreSelfSigned: "Self-signed certificate and its key (1_key.pfx)";
    RestoreCaSigned: "CSR, its key and the certificate from the CA (3_key.pfx)";
    RestoreFile: "Key file";
    RestoreFileHint: "Empty: the one in the folder";
    RestoreFormer: "Former backups are in folders named after their date.";
    RestorePasswordHint: "Empty: the connection password";
    RestoreButton: "Restore…";
    RestoreRequestOnly: "CSR and key, without a certificate from the CA: import the certificate afterwards";

    // type select
    TypeSelectTitle: "Type select";
    TypeSelectText: "The server shows this certificate to its clients";
    TypeSelectRule: "Choose a certificate type";
    TypeSelectLegacy: "User-specified certificates exist on firmware before 8.0.0 only";
    TypeInUse: "in use";
    TypeNotStored: "Not stored in the controller";
    // export and import of settings
    WhyLegacyOnly: "Only for firmware before 8.0.0; untick controllers with later firmware";
    ExportTitle: "Export settings";
    ImportTitle: "Import settings";
    ExportButton: "Export";
    ImportButton: "Import";
    ExportText: "Basic settings, users and activation keys are saved to an encrypted file on this computer. The server goes on running.";
    ImportSettingsText: "Basic settings, users and activation keys are put back from a file exported from the same controller. Either all of it is taken or nothing.";
    File: "File";
    FilePerSerial: "One file per controller, in the folder named after its serial number";
    ExportedAt: "Exported at";
    Passphrase: "Passphrase";
    PassphraseRule: "At least 8 characters, or none";
    ExportPassphraseTip: "If empty, each file is protected by the connection password of its controller. A controller without a connection password needs a passphrase.";
    ImportPassphraseTip: "The one the file was exported with. If empty, the connection password of the controller opens it.";
    ImportNothing: "There is no file that can be imported";

    // server log
    ServerLogCommand: "Server log…";
    ServerLogTip: "Read the log of the OPC UA server, save it or delete it";
    WhyOne: "Tick one controller only";
    LogFilter: "Filter lines";
    LogEmpty: "The log is empty. It is switched on in the basic settings.";
    LogNothingFound: "No line matches the filter";
    Save: "Save";
    SaveLog: "Save…";
    SaveLogTitle: "Save the server log";
    SaveLogText: "The whole log is read from the controller and saved as text. A file of the same name is replaced.";
    Refresh: "Refresh";
    DeleteLogButton: "Delete…";

    // verify
    VerifyTitle: "Verify";
    VerifyWorks: "Everything tried works";
    VerifyFails: "Not everything works";
    VerifyEndpoint: "Endpoint";
    VerdictWorks: "Works";
    VerdictFails: "Fails";
    VerdictNotTried: "Not tried";
    VerifyCertificate: "Server certificate";
    VerifyAccepted: "a careful client accepts it";
    VerifyRefused: "a careful client refuses it";
    VerifyAgain: "Verify again";
    VerifyTrust: "Trust this configurator…";
    VerifyTrustText: "The server lets in only clients whose certificate is in Trusted. That of this configurator is not there; it can be added now, or later from the file in this folder.";
    VerifyLogin: "To try logging in, give a user of the controller. The password is sent encrypted only, and not again once it was refused.";
    TrustConfiguratorTitle: "Trust this configurator";
    ConfirmTrustConfigurator: "The certificate of this configurator is put into Trusted and stays there: with a user of the controller, or where anonymous users are let in, it may connect like any other client.";
    VerifyAfterChanges: "After a change";
    VerifyAfterChangesOn: "Verify when the server has started again";

    // client certificates and CRLs
    TrustTitle: "Client certificates";
    TrustTrusted: "Trusted";
    TrustRejected: "Rejected";
    TrustIssuers: "Issuers";
    TrustFilter: "Filter by name, issuer, address or number";
    TrustNothingFound: "Nothing matches the filter";
    TrustTrustedEmpty: "Nobody is let in by a certificate yet. Add the certificate of a client, or let a client try to connect: it then appears under Rejected.";
    TrustRejectedEmpty: "No client was refused. One that tries to connect and is not let in appears here by itself.";
    TrustIssuersEmpty: "No authorities. Add the certificates of those that issued the certificates of clients, where these do not send them along.";
    TrustIssuersLegacy: "Firmware before 8.0.0 has no list of issuers. There, add authorities to Trusted.";
    TrustLegacyTrusted: "Firmware before 8.0.0 has no list of issuers; there, authorities go to Trusted";
    TrustFull: "The list is full: delete what is no longer needed first";
    TrustIssuersWhy: "Only for firmware 8.0.0 and later";
    TrustChoose: "Tick something, or click a line first";
    TrustBusy: "Applying the last change…";
    TrustIssuedTo: "Issued to";
    TrustIssuedBy: "Issued by";
    TrustFileName: "File name";
    TrustValidFrom: "Valid from";
    TrustValidUntil: "Valid until";
    TrustThumbprint: "Thumbprint (SHA-1)";
    TrustReason: "Reason";
    TrustAddress: "Address";
    TrustCount: "Times";
    TrustFirstSeen: "First seen";
    TrustLastSeen: "Last seen";
    TrustNotYetValid: "not valid yet";
    TrustNew: "new";
    TrustLive: "Live";
    TrustLiveTip: "What changes in the controller shows here within a second";
    TrustLost: "Connection lost, trying again";
    TrustEnded: "Not up to date";
    TrustAddTo: "Add…";
    TrustTrust: "Trust";
    TrustTrustTip: "Let these clients in from now on";
    TrustReject: "Reject";
    TrustRejectTip: "Move them to Rejected; their clients are disconnected at once";
    TrustUndo: "Undo";
    TrustUndoNothing: "Nothing was changed here that can be taken back";
    TrustTakenBack: "The change was taken back";
    TrustUndoTitle: "Undo the change of trust";
    TrustDetails: "Details…";
    TrustCutTitle: "Disconnected";
    TrustCutNone: "Nobody was disconnected";
    TrustPickLine: "Click a line to see all of it here";
    TrustMovedHere: "put here by a person, has not come since";
    TrustMoveTitle: "Trust anyway?";
    TrustMove: "Move";
    TrustDeleteTitle: "Delete certificates";
    TrustDeleteText: "Clients that are not trusted any more are disconnected at once. The OPC UA server goes on running. The deletion can be taken back until the dialog is closed.";
    TrustDeleteRejected: "They are forgotten until they try again. This cannot be taken back.";
    TrustAddTitle: "Add certificates";
    TrustAddFiles: "Files";
    TrustAddText: "Certificates and chains in any format: DER, PEM, P7B. CRLs in them come along. Several files can be chosen at once, or dropped here.";
    TrustAddRule: "Choose files first";
    TrustLeaveOutRule: "Leave out the files that cannot be used first";
    TrustLeaveOut: "Leave out";
    TrustTooMany: "At most 100 files at once";
    TrustDropHere: "Drop to see where they go; nothing is sent yet";
    TrustReadFile: "Read file";
    TrustGoesTo: "Goes to";
    TrustWhereGoes: "What goes where";
    TrustByKind: "Sort by kind";
    TrustByKindTip: "Clients to Trusted, authorities to Issuers, CRLs to CRL";
    TrustTrustedTip: "Everything to Trusted; authorities that come with the certificate of a client only complete its chain and go to Issuers";
    TrustIssuersTip: "Authorities only";
    TrustCrls: "CRL";
    TrustNothing: "nowhere";
    TrustKindClient: "client";
    TrustKindAuthority: "authority";
    TrustKindCrl: "CRL";
    TrustSkipRepeated: "is in the files twice";
    TrustSkipHeld: "is in the controller already";
    TrustSkipOutdated: "is older than the one in the controller";
    TrustSkipNotAsked: "is not what was asked for";
    TrustOnCurrent: "Firmware 8.0.0 and later";
    TrustOnLegacy: "Firmware before 8.0.0";
    TrustRevokesAtOnce: "Clients whose certificate is revoked are disconnected at once. The OPC UA server goes on running.";
    TrustCertificateTitle: "Certificate";
    TrustSubject: "Subject";
    TrustIssuerFull: "Issuer";
    TrustAlternativeNames: "Alternative names";
    TrustKeyUsages: "Key usages";
    TrustPurposes: "Purposes";
    TrustAuthority: "Authority";
    TrustSha256: "Thumbprint (SHA-256)";
    TrustChain: "Chain";
    TrustChainMissing: "missing: add its certificate to Issuers or Trusted";
    TrustChainRevoked: "revoked";
    TrustChainExpired: "expired";
    TrustChainNotCa: "is no authority";
    TrustChainNoCrl: "no usable CRL";
    TrustChainSent: "only sent by the client";
    TrustCopyPem: "Copy as PEM";
    CrlTitle: "CRL";
    CrlAddTitle: "Add CRL";
    CrlAddText: "CRL files in any format: DER, PEM, or within P7B. Several can be chosen at once, or dropped here.";
    CrlEmpty: "No CRLs. Without one, whether a certificate from an authority was revoked is not known. Add the current CRL of each authority.";
    CrlIssuer: "Issuer";
    CrlThisUpdate: "This update";
    CrlNextUpdate: "Next update";
    CrlEntries: "Revoked";
    CrlNumber: "CRL number";
    CrlHealth: "Health";
    CrlSignature: "Signature";
    CrlGood: "in use";
    CrlUnusable: "cannot be used";
    CrlExpired: "expired, get a new one";
    CrlNotYet: "not valid yet";
    CrlNoIssuer: "its issuer is in no list, no use yet";
    CrlWrongKey: "not signed by the issuer of this name, no use";
    CrlMayNotSign: "its issuer may not sign CRLs, no use";
    CrlNoEnd: "does not say until when it is valid, no use";
    CrlDeleteTitle: "Delete CRLs";
    CrlDeleteText: "The certificates they revoke count as valid again, or as unchecked. Clients that are not let in without them are disconnected at once. The deletion can be taken back until the dialog is closed.";
    CrlRevoked: "Revoked certificates";
    CrlRevokedNone: "It revokes no certificate";
    CrlWithoutTitle: "Authorities without a usable CRL";
    CrlWithoutText: "Whether their certificates were revoked is not known, so clients with one may be refused.";
    ChooseFilesTitle: "Choose files";
    KeyUndo: "Take the last change back, in client certificates and CRLs";
    KeyPanes: "Change to the next list, in client certificates";
    KeySideways: "Left, Right";

    // backup
    BackupTitle: "Backup";
    BackupOn: "Keep copies of certificates made here";
    BackupWhere: "Copies go to a folder per controller, named after its serial number";
    BackupKeys: "Keys are kept only for firmware before 8.0.0, protected by the connection password, which must not be empty. Later firmware makes its keys itself and never gives them away.";
    BackupRestore: "A backup is put back with Certificate › Restore backup.";

    // options
    OptionsTitle: "Options";
    LanguageLabel: "Language";
    ThemeLabel: "Theme";
    ThemeSystem: "System";
    ThemeLight: "Light";
    ThemeDark: "Dark";
    Parallelism: "Controllers at once";
    ParallelismTip: "How many controllers a job works on at the same time, 1 to 64";

    // help
    AboutText: "Sets up the OPC UA servers inside robot controllers: settings, users and certificates";
    AboutLicence: "Licence: MIT or Apache 2.0. The licences of all components are under Licences.";
    LicencesTitle: "Licences";
    LicencesFilter: "Filter by name or licence";
    LicencesNone: "Nothing matches the filter";
    WorkspaceLabel: "Workspace";
    KeyMove: "Move through the list";
    KeyTick: "Tick or untick the row";
    KeyRange: "Tick a range of rows";
    KeyConfirm: "Confirm a dialog";
    KeyCancel: "Cancel a dialog";
    KeyArrows: "Up, Down";
    KeySpace: "Space";
    KeyShiftClick: "Shift and click";
    KeyEnter: "Enter";
    KeyEscape: "Esc";

    // the small CA
    CaTitle: "Certificate authority";
    CaNone: "This workspace has no certificate authority yet";
    CaNoneText: "A certificate authority (CA) of your own signs the certificates of controllers and clients, so that everybody only has to trust one certificate. Its key stays on this computer, protected by a passphrase.";
    CaCreate: "Create CA…";
    CaRestore: "Restore backup…";
    CaCreateTitle: "Create CA";
    CaRestoreTitle: "Restore CA from backup";
    CaSignTicked: "Sign ticked controllers…";
    CaSignTickedTip: "Make or read the CSR of each ticked controller, sign it and import the certificate";
    CaSignTitle: "CA: sign and import";
    CaSignFile: "Sign CSR file…";
    CaSignFileTitle: "Sign CSR file";
    CaRevoke: "Revoke…";
    CaRevokeTitle: "Revoke certificates";
    CaPublish: "Publish CRL…";
    CaCrlTitle: "CA: publish CRL";
    CaBackUp: "Back up…";
    CaBackUpTitle: "Back up CA";
    CaIssued: "Issued certificates";
    CaIssuedNone: "No certificate has been issued yet";
    CaProfile: "For";
    CaServer: "Server";
    CaClient: "Client";
    CaValid: "Valid";
    CaExpired: "Expired";
    CaRevoked: "Revoked";
    CaCrl: "CRL";
    CaTickIssued: "Tick certificates first";
    CaNameHint: "For example Plant 3 CA";
    CaIntermediate: "With an intermediate CA that signs";
    CaIntermediateTip: "The root then only signs the intermediate, and its key (root.key) can be kept elsewhere.";
    CaKeep: "Keep the passphrase safe. Without it nothing can be signed or revoked, and nobody can restore it.";
    CaPassphraseAgain: "Passphrase again";
    CaPassphrasesDiffer: "The two passphrases differ";
    CaPassphraseRule: "At least 8 characters";
    CaPassphraseNeeded: "Enter the passphrase of the CA";
    CaSignText: "The server certificates of these controllers are replaced by ones the CA signs. A CSR is made where there is none; below firmware 8.0.0 that makes the present CA-signed certificate invalid at once.";
    CaNewKey: "Have the controllers make new keys";
    CaRenew: "Renew certificates that are still valid";
    CaAcceptWarnings: "Import even where some clients may complain";
    CaSignFileText: "The names in the request are taken over after a check, nothing else.";
    CaRequest: "Request";
    CaRevokeText: "Revoked certificates cannot be made valid again. Clients and controllers learn of it from the new CRL, so publish it to them afterwards.";
    CaReason: "Reason";
    CaPublishText: "A new CRL with a new date and number is made and saved in the CA folder.";
    CaPush: "Send it to the ticked controllers, and the CA certificate to their issuers list";
    CaPushNone: "Tick controllers to send it to them as well";
    CaTrust: "Trust the CA there: every client with a certificate from it is let in";
    CaBackUpText: "Keys, certificates and database in one file, which the passphrase of the CA opens.";
    CaRestoreText: "The backup is opened with the passphrase the CA had when it was made.";
    CaSign: "Sign";
    CaPublishNow: "Publish";
    CaRevokeNow: "Revoke";
    CaBackUpNow: "Back up";
    CaRestoreNow: "Restore";
    CaCreateNow: "Create";
    CaWorking: "Working…";
    ReasonUnspecified: "Not specified";
    ReasonKeyCompromise: "Key compromised";
    ReasonCaCompromise: "CA compromised";
    ReasonAffiliationChanged: "Name or owner changed";
    ReasonSuperseded: "Replaced by another certificate";
    ReasonCessation: "No longer in operation";
    ReasonPrivilegeWithdrawn: "Permission withdrawn";

    // the command line: headings of tables, in capitals
    HeadingActivated: "ACTIVATED";
    HeadingAddress: "ADDRESS";
    HeadingBits: "BITS";
    HeadingCa: "CA";
    HeadingCertificate: "CERTIFICATE";
    HeadingCertificates: "CERTIFICATES";
    HeadingCommonName: "COMMON NAME";
    HeadingController: "CONTROLLER";
    HeadingCrls: "CRLS";
    HeadingCrlNumber: "CRL NUMBER";
    HeadingDisconnected: "DISCONNECTED";
    HeadingEndpoint: "ENDPOINT";
    HeadingExpiry: "EXPIRY";
    HeadingFile: "FILE";
    HeadingFirmware: "FIRMWARE";
    HeadingGoesTo: "GOES TO";
    HeadingIdentity: "IDENTITY";
    HeadingIssuedBy: "ISSUED BY";
    HeadingIssuedTo: "ISSUED TO";
    HeadingIssuers: "ISSUERS";
    HeadingLicence: "LICENCE";
    HeadingLog: "LOG";
    HeadingName: "NAME";
    HeadingNextCrlBy: "NEXT CRL BY";
    HeadingNote: "NOTE";
    HeadingPolicies: "POLICIES";
    HeadingPort: "PORT";
    HeadingProfile: "PROFILE";
    HeadingRejected: "REJECTED";
    HeadingResult: "RESULT";
    HeadingRetrieved: "RETRIEVED";
    HeadingRevision: "REVISION";
    HeadingRevoked: "REVOKED";
    HeadingSerial: "SERIAL";
    HeadingStartup: "STARTUP";
    HeadingStatus: "STATUS";
    HeadingThumbprint: "THUMBPRINT";
    HeadingTokens: "TOKENS";
    HeadingTrusted: "TRUSTED";
    HeadingType: "TYPE";
    HeadingUsers: "USERS";
    HeadingUserToken: "USER TOKEN";
    HeadingVersion: "VERSION";
    HeadingWarnings: "WARNINGS";
    HeadingWhat: "WHAT";

    // the command line: words and sentences
    Confirmed: "Confirmed";
    SortedTip: "Click to sort, click again to turn the order round";
    CliAddUnconfirmed: "To add it now and confirm its identity later, use --unconfirmed.";
    CliVaultKeeps: "The vault is not open: passwords in it stay; \"vault status\" lists them, \"vault forget\" deletes them.";
    CliStopping: "Stopping after the step in hand; press Ctrl-C again to leave it unfinished…";
    CliGoOn: "Go on? [y/N]";
    CliClientsMayComplain: "clients may complain about what is listed above";
    CliFirmwareCurrent: "Controllers with firmware 8.0.0 and later";
    CliFirmwareLegacy: "Controllers with firmware below 8.0.0";
    CliError: "error";
    CliWarning: "warning";
    CliCertificateAccepted: "A careful client accepts the server's certificate";
    CliWindowBroughtToFront: "The workspace is open already; its window was brought to the front.";
    CliAskCaPassphrase: "Passphrase of the CA";
    CliAskVaultPassphrase: "Passphrase of the vault";
    CliAskNewVaultPassphrase: "New passphrase of the vault";
    CliAskAgain: "The same again";
    CliAskLogPassword: "Password for the server log (199532 in the manual)";
    CliProgramError: "The program ends because of an error in it";
}
