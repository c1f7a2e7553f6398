//! The main window, in English.

english_texts! { window:
    // the program
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

    // why a command is disabled
    WhyTick: "Tick at least one controller first";
    WhyEmpty: "The list is empty";
    WhyVirtual: "Not available in this build";

    // commands of the window itself
    TickAll: "Tick all";
    TickAllTip: "Tick every controller shown";
    Search: "Search";
    SearchTip: "Search name, address, serial number and type";
    CommandPalette: "Find command…";
    CommandPaletteTip: "Find any command by a part of its name";
    RowDetails: "Details";
    RowDetailsTip: "Show or hide the details of the controller under the cursor";
    Quit: "Quit";
    QuitTip: "Close the window";

    // command palette
    PaletteHint: "A part of the command's name";
    PaletteNone: "No command has this name";

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
    Confirmed: "Confirmed";
    SortedTip: "Click to sort, click again to turn the order round";
    DragColumnTip: "Drag to move the column";

    // details of a row
    DetailsChoose: "Choose a controller: click its row or use the arrow keys";
    DetailsServer: "OPC UA server";
    DetailsFirmware: "Firmware";
    DetailsLastResult: "Last result";
    DetailsNoResult: "No job since the window was opened";
    DetailsLists: "Settings and lists";
    DetailsRead: "Read settings and lists";
    DetailsNotRead: "Not read since the window was opened";
    DetailsNoCertificate: "No certificate";
    DetailsNone: "None";
    DetailsApplicationUri: "Application URI";

    // welcome
    WelcomeTitle: "No controllers yet";
    WelcomeText: "Add the controllers whose OPC UA servers you want to set up";
    WelcomeAdd: "Add a controller";
    WelcomeVirtualText: "No robot at hand? Simulated controllers run on this computer and behave like real ones";
    StartingVirtual: "Starting virtual controllers…";
    TryVirtual: "Try it with virtual controllers";
    TryVirtualTip: "Start a few simulated controllers on this computer and add them to the list";

    // backup
    Backup: "Backup…";
    BackupTip: "Keep copies of certificates in the workspace";
    BackupTitle: "Backup";
    BackupOn: "Keep copies of certificates made here";
    BackupWhere: "Copies go to a folder per controller, named after its serial number";
    BackupKeys: "Keys are kept only for firmware before 8.0.0, protected by the connection password, which must not be empty. Later firmware makes its keys itself and never gives them away.";
    BackupRestore: "A backup is put back with Certificate › Restore backup.";

    // options
    Options: "Options…";
    OptionsTip: "Language, theme and controllers worked on at once";
    OptionsTitle: "Options";
    LanguageLabel: "Language";
    ThemeLabel: "Theme";
    ThemeSystem: "System";
    ThemeLight: "Light";
    ThemeDark: "Dark";
    Parallelism: "Controllers at once";
    ParallelismTip: "How many controllers a job works on at the same time, 1 to 64";

    // help
    Shortcuts: "Keyboard shortcuts";
    ShortcutsTip: "Every key this window knows";
    Licences: "Licences…";
    LicencesTip: "The licences of everything this program is made of";
    About: "About";
    AboutTip: "Version and licence";
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
    KeyDetails: "Show the details of the row";
    KeyRowMenu: "Menu of the row";
    KeyMenu: "Menu key or Shift+F10";
    KeyEnterRow: "Enter or double click";
}
