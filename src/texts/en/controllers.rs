//! The list of controllers, in English.

english_texts! { controllers:
    // add a controller
    AddController: "Add controller…";
    AddControllerTip: "Register a controller by its name, address and connection password";
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

    // confirm identity
    ConfirmIdentity: "Confirm identity…";
    ConfirmIdentityTip: "Compare the fingerprint of the ticked controllers before anything is sent to them";
    WhyConfirmed: "Every ticked controller is confirmed already";

    // delete
    DeleteControllers: "Delete…";
    DeleteControllersTip: "Remove the ticked controllers from the list";
    DeleteTitle: "Delete from the list";
    DeleteText: "They are removed from the list with their connection passwords. Nothing is changed in the controllers, and saved files stay.";
    DeleteVaultClosed: "The vault for passwords is closed: open it first, or their passwords stay in it.";

    // connection list
    ConnectionList: "Get connection list…";
    ConnectionListTip: "Register controllers from a connection list";
    ConnectionListTitle: "Get connection list";
    ConnectionListText: "A CSV file with the columns Name, Type and Address. Controllers on USB and simulated ones are left out.";
    Import: "Import";
    NothingToImport: "There is no new controller in the file";
    TickConnection: "Tick at least one controller to import";
    SeriesGuess: "The list does not say it. What the controller says of itself replaces it.";
    LinesLeftOut: "Left out";
    ImportText: "Nothing is sent to them until you have compared their fingerprints.";

    // connection password
    EnterPassword: "Enter password…";
    PasswordTitle: "Connection password needed";
    PasswordText: "Enter the password for Ethernet connections that is set in these controllers";
    PasswordUse: "Use for these controllers";
    PasswordNotKept: "The password is known until this window is closed. A vault keeps it without a keyring, see the options.";
}
