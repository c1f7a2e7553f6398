//! The certificates of the OPC UA server, in English.

english_texts! { server_certificates:
    // self-signed
    SelfSigned: "Self-signed…";
    SelfSignedTip: "Make a self-signed server certificate and install it";
    ActSelfSigned: "Create certificate";
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

    // export self-signed, CA signed, user specified
    ExportSelfSigned: "Export self-signed…";
    ExportSelfSignedTip: "Save the self-signed server certificate to a file";
    CaSigned: "CA signed…";
    CaSignedTip: "Make a certificate signing request and import the signed certificate";
    UserSpecified: "User specified…";
    UserSpecifiedTip: "Install a server certificate made elsewhere";
    ActCreateCsr: "Create CSR";
    WhyUserOne: "For one controller at a time: tick only that one";
    WhyUserLegacy: "Only for firmware before 8.0.0";
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
    RestoreBackup: "Restore backup…";
    RestoreBackupTip: "Put a key and its certificate back into the controllers from a backup";
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
    TypeSelect: "Type select…";
    TypeSelectTip: "Choose which of the installed server certificates is used";
    ActSelectType: "Switch certificate";
    TypeSelectTitle: "Type select";
    TypeSelectText: "The server shows this certificate to its clients";
    TypeSelectRule: "Choose a certificate type";
    TypeSelectLegacy: "User-specified certificates exist on firmware before 8.0.0 only";
    TypeInUse: "in use";
    TypeNotStored: "Not stored in the controller";
}
