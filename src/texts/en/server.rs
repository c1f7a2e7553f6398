//! The OPC UA server and its settings, in English.

english_texts! { server:
    // information, start and stop
    Start: "Start";
    StartTip: "Start the OPC UA server of the ticked controllers";
    Stop: "Stop";
    StopTip: "Stop the OPC UA server of the ticked controllers";
    GetInfo: "Get new information";
    GetInfoTip: "Read status, certificate and activation of the ticked controllers";

    // basic settings
    BasicSettings: "Basic settings…";
    BasicSettingsTip: "Port, startup mode, security policies, user tokens and server log";
    ActSettings: "Change settings";
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
    Users: "Users…";
    UsersTip: "List, add and delete the users of the OPC UA server";
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

    // activation
    Activation: "Activation…";
    ActivationTip: "Enter licence and activation keys";
    ActActivate: "Activate";
    WhyActivationOption: "Firmware 8.0.0 and later is activated as a controller option";
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

    // export and import of settings
    ExportSettings: "Export…";
    ExportSettingsTip: "Save the server settings to a file";
    ImportSettings: "Import…";
    ImportSettingsTip: "Take the server settings from a file";
    ActImportSettings: "Replace settings";
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
}
