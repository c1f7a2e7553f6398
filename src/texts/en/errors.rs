//! What a person reads about each error, in English: what happened, why, and what to do (manual 6.1 and 6.2).

error_texts! {
    NotActivated:
        "The OPC UA server is not activated",
        "The controller has no valid OPC UA licence.",
        "Activate the OPC UA function, then start the server again.";
    NoCertificate:
        "No server certificate is configured",
        "The controller holds no certificate of the selected type.",
        "Create or import a server certificate, or select another certificate type.";
    InvalidParameter:
        "The OPC UA server has an invalid parameter",
        "A value in the server settings or in the server certificate does not fit.",
        "Check the basic settings and the server certificate.";
    PortConflict:
        "The port of the OPC UA server is already in use",
        "Another function of the controller uses the same TCP port.",
        "Choose another port in the basic settings.";
    ServerError:
        "The OPC UA server failed",
        "The server inside the controller met an internal error.",
        "Restart the controller. If it happens again, switch on the server log and send it to support.";
    ServerLogOn:
        "The server log is switched on",
        "The OPC UA server writes its log, which fills the controller's storage in time.",
        "Switch the server log off in the basic settings, then restart the controller.";
    ServerLogFull:
        "The server log is over its size limit",
        "The log file reached its limit and the OPC UA server stopped itself.",
        "Switch the server log off and delete it in the basic settings, then restart the controller.";
    Unreachable:
        "The controller cannot be reached",
        "It is switched off, the network cable is unplugged, or the address is wrong.",
        "Switch the controller on, check the cable and the address, then try again.";
    Timeout:
        "The controller does not answer",
        "It accepted the connection but sent no answer in time.",
        "Wait until the controller has finished what it is doing, then try again. If it stays silent, restart it.";
    ConnectionLost:
        "The connection was lost during the operation",
        "The network cable was pulled, or the controller was restarted, before the answer arrived.",
        "Check the connection, get new information to see what was done, then repeat what is missing.";
    AnswerLost:
        "The change was applied, but its answer was lost",
        "The connection broke after the change was sent. Read again, the controller shows that it was changed.",
        "Compare the row with what was wanted. Repeat the operation if something was to be saved on this computer.";
    HandshakeLost:
        "The connection ended before encryption was agreed on",
        "The controller has too many connections at the moment, or the port belongs to another service.",
        "Try again in a minute. If it happens again, check the address and the port of the controller's management.";
    NotAController:
        "What answers at this address is not a controller",
        "Something answers, but not with the controller-management protocol.",
        "Check the address and the port. The port is that of the controller's management, not of its OPC UA server.";
    ProtocolVersion:
        "The controller speaks another version of the management protocol",
        "Its firmware is newer or older than this program supports.",
        "Update this program, or the controller's firmware.";
    FingerprintChanged:
        "The controller's identity has changed",
        "The fingerprint is not the one confirmed when the controller was added. The controller was replaced, or somebody is between you and it.",
        "Compare the fingerprint with the one the controller shows. If the change is right, delete the controller and add it again; if not, tell your network administrator.";
    FingerprintUnknown:
        "The controller's fingerprint has not been confirmed",
        "A controller is only talked to once its fingerprint was compared and accepted.",
        "Compare the fingerprint with the one the controller shows, then confirm it.";
    WrongPassword:
        "The connection password is wrong",
        "The controller did not accept the password for Ethernet connections.",
        "Enter the password that is set in the controller.";
    PasswordMissing:
        "The connection password is not known",
        "It was not entered yet, or this computer has no keyring to keep it in.",
        "Enter the connection password of the controller. A vault keeps it without a keyring (Options, vault init).";
    LockedOut:
        "The controller refuses further attempts for a while",
        "A wrong connection password was sent too often.",
        "Wait for a minute, then try again with the right password.";
    SessionExpired:
        "The session with the controller has ended",
        "The controller was restarted or the session was idle for too long.",
        "Repeat the operation.";
    FirmwareNotSupported:
        "The controller's firmware does not support OPC UA",
        "The firmware is older than the first version with an OPC UA server.",
        "Update the firmware: RC90 and RC700 from 7.5.4, T/VT from 7.5.54, RC800 from 8.0.0.";
    FirmwareTooNew:
        "This function is not available on firmware 8.0.0 or later",
        "The controller makes its keys itself and is activated as a controller option.",
        "Use the function that replaces it for current firmware.";
    FirmwareTooOld:
        "This function needs firmware 8.0.0 or later",
        "The controller's firmware is older.",
        "Update the firmware, or leave this controller out.";
    TaskRunning:
        "A task is running in the controller",
        "The controller cannot be configured while it runs a program.",
        "Wait for the task to finish or stop it, then try again.";
    TeachPendantConnected:
        "A teach pendant is connected to the controller",
        "The controller cannot be configured while a teach pendant has control.",
        "Disconnect the teach pendant, then try again.";
    ChangedMeanwhile:
        "The controller was changed by somebody else",
        "Its configuration is newer than the one this change was based on. Nothing was changed.",
        "Get new information, check the settings, then make the change again.";
    TooManyUsers:
        "The controller has the most users it can take",
        "A controller takes at most 10 users.",
        "Delete a user that is no longer needed, then add the new one.";
    UserExists:
        "A user of this name already exists",
        "The controller already has a user with the same name.",
        "Choose another name, or delete the existing user first.";
    UserNotFound:
        "The user does not exist",
        "The controller has no user of this name; it may have been deleted meanwhile.",
        "Open the user list again.";
    ListFull:
        "More certificates than the controller can take",
        "The list in the controller would grow over its limit. Nothing was sent.",
        "Delete certificates that are no longer needed, or add fewer.";
    DuplicateCertificate:
        "The certificate is already in the list",
        "The controller already holds exactly this certificate.",
        "Nothing needs to be done.";
    NotInList:
        "The controller does not hold this any more",
        "The certificate or CRL is not in the list, or somebody else removed it meanwhile.",
        "List again to see what the controller holds now.";
    NotAnAuthority:
        "The certificate is not one of an authority",
        "Only authorities, which sign other certificates, belong in the list of issuers.",
        "Add the certificate of an application to the trusted list.";
    TooManyCrls:
        "More CRLs than the controller can take",
        "The controller's room for CRLs would be exceeded. Nothing was sent.",
        "Delete CRLs that are no longer needed, or add fewer.";
    DuplicateCrl:
        "The controller already holds this CRL",
        "The controller holds exactly this CRL.",
        "Nothing needs to be done.";
    CrlOutdated:
        "The CRL is older than the one in the controller",
        "The controller holds a CRL of the same issuer that is as new or newer. With the older one, certificates revoked since would be valid again.",
        "Get the latest CRL from the issuer. If the older one is really meant, delete the newer one first.";
    DiskFull:
        "The controller's storage is full",
        "The change could not be saved in the controller. Nothing was changed.",
        "Delete the server log or other files in the controller, then try again.";
    Refused:
        "The controller refused the operation",
        "The controller's own rules do not allow it in its present state.",
        "See the detail, then check the controller's state.";
    LogPassword:
        "The password for the server log is missing or wrong",
        "Switching the server log on needs the password 199532 (manual 2.6.1), so that nobody does it by mistake.",
        "Enter 199532. In normal use the server log stays off.";
    RequestTooLarge:
        "The request is too large for the controller",
        "More data was sent than the controller accepts at once.",
        "Send fewer or smaller files.";
    UnknownSeries:
        "There is no controller series of this name",
        "The series are RC90, RC700, T/VT and RC800.",
        "Give one of them, as it stands on the controller.";
    NothingToChange:
        "Nothing to change was given",
        "The command changes only the settings that are given as options, and there are none.",
        "Give at least one option; --help lists them.";
    UnknownComponent:
        "No component of this name is linked in",
        "The list of licences has no entry of this name.",
        "See the names with: opcua-configurator licences";
    BadName:
        "The name cannot be used",
        "A name has 1 to 32 characters and no control characters.",
        "Enter another name.";
    BadAddress:
        "The address is not valid",
        "An address is an IP address or a host name, with or without a port.",
        "Enter an address such as 192.168.0.1 or robot-7:7943.";
    BadPort:
        "The port number must be between 0 and 65535",
        "The port is not a number, is out of range, or belongs to the system (0 to 1023).",
        "Enter a port from 1024 to 65535 in half-width digits.";
    BadSettings:
        "The server settings are not complete",
        "At least one security policy and one user token policy must be chosen.",
        "Complete the settings.";
    BadCredential:
        "The user name or password is not allowed",
        "Both have 8 to 32 half-width letters and digits, no symbols.",
        "Enter another user name or password.";
    BadCertificateRequest:
        "A certificate field has a value that is not allowed",
        "Full-width characters, symbols outside the printable ones, or a value out of range were entered.",
        "Correct the field.";
    BadCertificate:
        "The file holds no usable certificate",
        "It is damaged, or not an X.509 certificate in PEM or DER.",
        "Choose another file, or export the certificate again.";
    BadCrl:
        "The file holds no usable CRL",
        "It is damaged, not a CRL in PEM or DER, or of a kind that controllers do not understand.",
        "Choose another file, or get the CRL from the issuer again.";
    BadFingerprint:
        "This is not a fingerprint",
        "A fingerprint is the SHA-256 of the controller's identity: 64 hexadecimal digits.",
        "Copy the fingerprint as the controller shows it.";
    NameTaken:
        "Another controller already has this name",
        "Names in the list are unique.",
        "Choose another name.";
    AddressTaken:
        "Another controller already has this address",
        "The same address and port are registered under another name.",
        "Check the address, or delete the other entry.";
    UnknownController:
        "No controller of this name is in the list",
        "The name is mistyped, or the controller was added in another workspace.",
        "See the list of controllers for the names.";
    FileUnreadable:
        "The file cannot be read",
        "It does not exist, or this account may not read it.",
        "Check the file's name and its permissions.";
    NotConfirmed:
        "The operation was not confirmed",
        "It stops, replaces or deletes something, or there is something to think about first, and there is no terminal to ask on.",
        "Repeat the command with --yes.";
    CsrMismatch:
        "The certificate and the CSR do not match",
        "The certificate was not issued for the CSR that the controller holds.",
        "Import the certificate that the CA issued for this controller's latest CSR.";
    NoCsr:
        "The controller holds no CSR",
        "A CA-signed certificate can only be imported for a CSR that was made before.",
        "Create a CSR, have it signed by the CA, then import the certificate.";
    CertificateNotStored:
        "The controller holds no certificate of this type",
        "None was created or imported yet, or it was removed.",
        "Create or import the certificate first.";
    CertificateExpired:
        "The certificate has expired",
        "Its validity ended before the date of the controller's clock.",
        "Have a new certificate issued. If the controller's clock is wrong, set it.";
    KeyLengthNotAllowed:
        "The key length does not fit the security policies",
        "One of the ticked security policies does not allow keys of this length.",
        "Use a certificate with another key length, or change the security policies in the basic settings.";
    KeyMismatch:
        "The certificate and the private key are not a pair",
        "The certificate was issued for another key.",
        "Choose the key and the certificate that belong together.";
    WrongKeyPassword:
        "The password of the private key is wrong",
        "The file cannot be opened with this password, or none was given. Where the file does not allow to tell, it may also be damaged.",
        "Enter the password that was set when the file was made.";
    FileNotFound:
        "The file to be imported was not found",
        "There is no such file in the import folder of this controller.",
        "Put the file into the folder named in the detail.";
    SeveralFiles:
        "More files than can be imported",
        "The import folder holds several files of this kind; exactly one is expected.",
        "Leave only the file that is to be imported in the folder.";
    BadFileName:
        "The file name cannot be used",
        "It contains characters other than half-width letters, digits and underscores, or Windows keeps the name for itself: CON, NUL, COM1, names that end with a dot or a blank.",
        "Rename the file or the folder.";
    FileFormat:
        "The file has the wrong format",
        "Its content is damaged, or is not what was chosen to be imported.",
        "See the detail, then convert or export the file again.";
    OneControllerOnly:
        "This works on one controller at a time",
        "What was given belongs to one controller: each has keys and a certificate of its own.",
        "Choose one controller only.";
    Preflight:
        "OPC UA clients would refuse the certificate",
        "It does not fit the controller it is meant for. Nothing was sent.",
        "See the detail for what is wrong, then have the certificate issued again.";
    PreflightWarnings:
        "Some OPC UA clients may complain about the certificate",
        "It can be used, but not everything about it is as it should be. Nothing was sent.",
        "See the detail, then have the certificate issued again, or import it all the same (command line: --accept-warnings).";
    NoAuthority:
        "There is no certificate authority in this workspace",
        "The small CA has not been created yet, or another workspace is open.",
        "Create the CA first, or restore it from a backup.";
    AuthorityExists:
        "The workspace has a certificate authority already",
        "A workspace holds one CA. Another one would make everything it signed worthless.",
        "Use the one that is there, or another workspace. To start anew, move its folder away first.";
    AuthorityBusy:
        "The certificate authority is in use",
        "Another window or command is working with the CA of this workspace.",
        "Wait until it has finished, then try again.";
    AuthorityDamaged:
        "The files of the certificate authority are damaged",
        "The database, the certificate or the key of the CA is missing, cut short or was changed. Nothing was written to it.",
        "Move the CA's folder away and restore it from a backup.";
    AuthorityPassphrase:
        "The passphrase of the certificate authority is wrong",
        "The passphrase does not open the CA's key, or the key file is damaged.",
        "Enter the passphrase that was chosen when the CA was created.";
    NoPassphrase:
        "No passphrase was given",
        "There is no terminal to ask for it, or the two entries differ.",
        "Name a file with --passphrase-file, or enter the same passphrase twice.";
    AuthorityExpired:
        "The certificate authority is not valid now",
        "Its certificate has expired, or this computer's clock is wrong. Nothing it signs would be accepted.",
        "Check the clock. If the CA has expired, create a new one and have all certificates signed by it.";
    CsrRefused:
        "The certificate authority does not sign this request",
        "The certificate signing request lacks something OPC UA needs, or asks for something that does not belong into a certificate.",
        "See the detail, then make the request again with the right names.";
    ShortKey:
        "The key of the signing request is too short",
        "Keys below 2048 bits are for deprecated security policies only and can be broken.",
        "Make the request again with a longer key, or allow short keys if the controller needs one.";
    AlreadySigned:
        "There is a valid certificate for this request",
        "The CA signed the same key before, and that certificate is neither revoked nor expired.",
        "Use that certificate, or ask for a renewal.";
    UnknownSerial:
        "The certificate authority has not issued this certificate",
        "No certificate with this serial number is in its database.",
        "Compare the serial number with the list of issued certificates.";
    AlreadyRevoked:
        "The certificate has been revoked already",
        "A revocation cannot be changed or taken back.",
        "Publish the CRL so that everybody learns of it.";
    BackupDamaged:
        "The file is no whole backup of a certificate authority",
        "It is cut short or was changed, of a newer version, or another file altogether.",
        "Choose another copy of the backup.";
    BackupPassphrase:
        "The passphrase does not open the backup",
        "The backup was made with another passphrase, or was changed since.",
        "Enter the passphrase the CA had when the backup was made.";
    VerifyFailed:
        "Not everything the OPC UA server offers works",
        "Connecting as an OPC UA client failed in at least one way, or something about the server is wrong.",
        "Do what the report says for each failure, then verify again.";
    ServerNotRunning:
        "The OPC UA server is not running",
        "Values can only be read from a running server.",
        "Start the OPC UA server of the controller, then try again.";
    NoSuitableEndpoint:
        "The OPC UA server offers no suitable endpoint",
        "No endpoint shows the selected server certificate and takes this login over a protected connection.",
        "Check security policies and user tokens in the basic settings. Verify shows what each endpoint offers.";
    ConfiguratorNotTrusted:
        "The OPC UA server does not trust this program",
        "The certificate of this program is not in the trusted list of the controller.",
        "Run Verify with the option to trust this program first, then try again.";
    OpcUaLoginRefused:
        "The OPC UA server refuses the login",
        "User name or password is wrong, or the server takes no anonymous clients.",
        "Check user name and password against the users of the controller.";
    OpcUaConnectionFailed:
        "The connection to the OPC UA server failed",
        "The server did not answer, closed the connection, or sent something that cannot be read.",
        "Check that the server runs and that no firewall blocks its port. Verify shows how far a connection comes.";
    NoDataNodes:
        "The server does not offer this data",
        "The nodes of the force sensor or the motion log are missing, or have values that they cannot have. Motion logs need firmware 8.0.0 or later; force sensor data needs a force sensor.",
        "Check the firmware and the option of the controller. After a change of hardware, restart the controller.";
    DataSettingsRefused:
        "The controller does not accept the settings of the recording",
        "The server refused to set DataType, DataNum, SamplingInterval or Port.",
        "Log in as a user who may write, or choose other settings. Another client may be recording already.";
    NoRecordingDescription:
        "The description of the recording is missing",
        "A CSV or Parquet file of the recorder is read with the .json file beside it, which says what was recorded and what is missing.",
        "Copy the .json file into the same folder, without a change of its name. If the packets were kept, open the .packets file.";
    SerialPortUnavailable:
        "The serial port cannot be opened",
        "It does not exist, another program uses it, or this user may not open it.",
        "Check the name of the port and the cable, close other programs that use the port, and give this user the right to open it (on Linux: the group of the device, often dialout).";
    RemoteNoAnswer:
        "The controller does not answer the remote command",
        "The connection is there, but no complete answer came in time. On a serial line the speed, the parity or the wiring may be wrong, or the remote function is switched off in the controller.",
        "Check that remote Ethernet or remote RS232 is switched on in the controller, and compare its settings with those of this command. A longer limit is set with --timeout.";
    RemoteOccupied:
        "The controller closed the remote connection before the login",
        "It talks to one remote client at a time, and another one is connected, or remote Ethernet is not switched on.",
        "Disconnect the other client, or wait until its time-out in the controller is over. Check the remote settings of the controller.";
    RemoteAnswerUnreadable:
        "The answer to the remote command cannot be read",
        "What answers is not a controller with remote commands, uses the other form (text or frames), or the line damages bytes.",
        "Check the address and the port. On a serial line, check speed, parity and shielding.";
    RemoteCommandUnknown:
        "The controller does not know the remote command, or nobody is logged in",
        "The firmware is too old for the command, or the session ended in the meantime.",
        "Repeat the command. If it is refused again, update the firmware of the controller or do without the command.";
    RemoteWrongPassword:
        "The password for remote commands is wrong",
        "The controller has another password for remote Ethernet or remote RS232. It has up to 16 printable characters.",
        "Give the password that is set in the controller with --password-file.";
    RemotePasswordRequired:
        "The controller wants a password for remote commands",
        "It has a global IP address, and lets nobody in there without a password.",
        "Set a password for remote Ethernet in the controller and give it with --password-file.";
    RemoteRequestRefused:
        "The controller refused the form of the remote command",
        "A number, a count or a text in it is not what this firmware expects.",
        "Check the values against the manual of the controller, such as the numbers of I/O, robots and functions that exist there.";
    RemoteVariableUnknown:
        "The controller has no such variable",
        "The project declares no Global Preserve variable of that name and type, or the array has other dimensions or fewer elements.",
        "Check name, type and elements against the project in the controller. Build and transfer the project after a change.";
    RemoteLineDisturbed:
        "The remote command arrived damaged or incomplete",
        "Bytes were lost or changed on the line, so that the controller did nothing.",
        "Check speed, parity, wiring and shielding of the serial line, then repeat the command.";
    RemoteExecuteRunning:
        "The controller still executes a command",
        "While Execute runs, only abort, status and setting outputs are accepted.",
        "Wait until the command has ended, or end it with abort.";
    RemoteSystemError:
        "The controller reports a system error for the remote command",
        "The controller met an internal or communication error (code 99). An Execute may have a wrong command text.",
        "Look at the error in the controller. Correct the text of an Execute. Restart the controller if it happens again.";
    RemoteNotReady:
        "The controller does not accept the remote command in its present state",
        "A condition for this command is not met; the states that it needs are named.",
        "Bring the controller into these states, then repeat the command.";
    RemoteOutcomeUnknown:
        "It is not known whether the remote command was done",
        "It was sent, and its answer was lost or damaged. It was not sent again, since it may move or switch something.",
        "Look at the machine and at its status before you repeat the command.";
    RemoteRequestInvalid:
        "The remote command cannot be sent",
        "A name, a number or a text in it has a form that the protocol cannot carry, or the command does not exist over this connection.",
        "Correct the argument that is named. Monitoring commands need a connection with tcp://.";
    BadRemoteTarget:
        "The connection for remote commands is written wrongly",
        "It is neither tcp://HOST[:PORT], raw-tcp://HOST:PORT nor serial:DEVICE, and no controller in the list has this name.",
        "Correct it, such as tcp://192.168.0.1, raw-tcp://192.168.0.7:4001 or serial:/dev/ttyS0?baud=19200.";
    PlcUnreachable:
        "The PLC cannot be reached",
        "It is switched off, the network cable is unplugged, the address is wrong, or nothing listens at the port.",
        "Check power, cable, address and port of the PLC. FINS has port 9600 unless the PLC's settings say otherwise.";
    PlcConnectionRefused:
        "The PLC refused the connection",
        "All its connections are in use, the node is connected already or out of range, this computer's address is not admitted, or another node answers there.",
        "Close connections that are not needed, choose another node or none, and check the FINS/TCP settings of the PLC.";
    PlcConnectionLost:
        "The connection to the PLC was lost",
        "The cable was unplugged, the PLC was switched off, or it closed the connection before it answered.",
        "Check cable and PLC, then try again.";
    PlcNoAnswer:
        "The PLC does not answer",
        "The command was sent and no answer to it came in time. With FINS/UDP, node and port can be wrong as well.",
        "Check the cable and whether the PLC is busy. With FINS/UDP, check the nodes of both sides.";
    PlcCommandRefused:
        "The PLC refused the command",
        "The end code of the answer says why.",
        "Follow the advice for the end code, then try again.";
    PlcWriteUnknown:
        "It is not known whether the PLC has written the values",
        "The command was sent, and its answer was lost.",
        "Read the values to see what the PLC has, then decide whether to write them again.";
    NotFins:
        "What answers there is no PLC with FINS",
        "Something answers at this address and port, but not in FINS, or not in the kind of FINS that was chosen.",
        "Check address and port, and choose between TCP and UDP.";
    BadPlcAddress:
        "The address in the PLC is wrong",
        "It names no area, word or bit, or does not fit what is to be done with it.",
        "Write it as D300, D300.04, CIO0.15, W10, E1_200, T5 or T5.F.";
    BadPlcValue:
        "The value does not fit",
        "It is no value of the chosen type, is outside its range, or the PLC's words hold no value of that type.",
        "Correct the value, or choose another type.";
    BadBridgeMap:
        "The bridge's map cannot be used",
        "It is not written as a map has to be, or a row in it is wrong.",
        "Correct what is named, then try again. The sample fins-bridge.toml shows the form.";
    PlcCannotListen:
        "The simulated PLC cannot start",
        "Another program uses its port, this account may not open it, the address is not one of this computer, or the node is not 1 to 254.",
        "Stop the other program, or choose another port, address or node.";
    WrongKeys:
        "The controller does not accept the keys",
        "The licence key or the activation key was made for another serial number, or has a typing mistake.",
        "Compare both keys with what the supplier sent for this serial number.";
    NotInFile:
        "The activation file has no keys for this controller",
        "No good line of the file carries the controller's serial number.",
        "Add the line or correct it, or choose the file that belongs to this controller.";
    BadActivationKey:
        "The licence key or the activation key is incomplete",
        "A licence key has 16 half-width letters and digits, an activation key 24.",
        "Enter the keys as the supplier sent them.";
    BadActivationFile:
        "The file is not an activation file",
        "It is not UTF-8 text, or its first line is not OPCUA.Activation.Ver.1.0.",
        "Choose another file, or save it again as CSV in UTF-8 with that first line.";
    BadIoLabels:
        "The file holds no labels of I/O",
        "No line has a kind, a number and a label, or the file is no text in UTF-8 or UTF-16.",
        "Write lines such as input,0,Door closed with the kinds input, output and memory, and save the file as CSV in UTF-8.";
    BadConnectionList:
        "This is not a connection list, or not a line of one",
        "A connection list is a CSV file in UTF-8 with the columns Name, Type and Address.",
        "Choose another file, or correct the line.";
    ExportMissing:
        "No settings were exported from this controller",
        "The controller's folder in the workspace holds no option.json.",
        "Export the settings first, or copy the exported file into the folder named by the serial number.";
    ExportRenamed:
        "The name of the exported file was changed",
        "Settings are imported from the file option.json only.",
        "Give the file its name back.";
    ExportOfAnother:
        "The exported settings belong to another controller",
        "The file was exported from a controller with another serial number or of another series.",
        "Put each file back into the folder named by its controller's serial number.";
    ExportVersion:
        "The exported settings are of another version",
        "The file has a format this program does not know, or comes from newer firmware than the controller's.",
        "Update this program or the controller's firmware, or export the settings again.";
    ExportDamaged:
        "The exported settings are damaged",
        "The file is cut short or was changed, or it is not a settings export.",
        "Restore the file from a copy, or export the settings again.";
    WrongPassphrase:
        "The passphrase does not open the exported settings",
        "They were sealed with another passphrase, or with the connection password the controller had then.",
        "Enter the passphrase of the export.";
    BadPassphrase:
        "The passphrase is too short",
        "A passphrase that protects an export or a CA has at least 8 characters.",
        "Choose a longer passphrase.";
    UnprotectedFile:
        "The connection password is empty and protects no file",
        "A backup of a key, and an export of settings without a passphrase, are protected by the connection password of the controller. With an empty one everybody who can read the file could open it, so nothing was changed.",
        "For an export, give a passphrase. For a backup of keys, set a connection password in the controller, or switch the backup off.";
    WorkspaceReadOnly:
        "The workspace cannot be written",
        "This account may not write into the workspace folder.",
        "Change the folder's permissions, or choose another workspace with --workspace.";
    WorkspaceFull:
        "The disk of the workspace is full",
        "The file could not be written completely and was left as it was before.",
        "Free some space, then try again.";
    WorkspaceBusy:
        "The workspace is open in another window",
        "Only one instance of the program works on a workspace at a time.",
        "Use the other window, or close it first.";
    FileInUse:
        "A file is in use by another program",
        "Another program has the file open, such as a virus scanner, a backup, a spreadsheet or an editor.",
        "Close the file in the other program, then try again; until then the file keeps its old content.";
    ConfigurationDamaged:
        "The configuration file was damaged",
        "It could not be read as a configuration. It was kept under another name, and an empty one is used.",
        "Restore the controllers from a backup of the file, or add them again.";
    KeyringUnavailable:
        "The password cannot be kept on this computer",
        "There is no operating-system keyring, or it is locked.",
        "Unlock the keyring, create a vault for passwords (Options, vault init), or enter the password at each start.";
    VaultMissing:
        "There is no vault for passwords",
        "This workspace has no vault: none was created, or its file was moved or deleted.",
        "Create one (Options, vault init), or restore the file.";
    VaultExists:
        "There is a vault already",
        "A workspace has one vault for passwords, and it is not replaced.",
        "Open the vault that is there. To start anew, move its file away first.";
    VaultLocked:
        "The vault for passwords is not open",
        "Its passphrase was not entered, or was changed by another program since.",
        "Enter the passphrase of the vault (--vault-passphrase-file), or the connection password.";
    VaultPassphrase:
        "The passphrase does not open the vault",
        "The passphrase is wrong.",
        "Enter the passphrase that was chosen for the vault of this workspace.";
    VaultDamaged:
        "The vault for passwords is damaged",
        "Its file was changed, cut off or replaced. It is left as it is.",
        "Restore the file from a backup. To start anew, move it away and create a vault.";
    VaultVersion:
        "The vault is of a later version",
        "It was written by a later version of this program. It is left as it is.",
        "Update this program.";
    VaultFull:
        "The password does not fit into the vault",
        "A vault holds at most 20,000 passwords of at most 1,024 bytes each.",
        "Take passwords that are not needed out of it (vault forget), or use a shorter password.";
    BadPasswordList:
        "The file is not a list of connection passwords",
        "It is a CSV file with the columns Name,Password, one controller a line.",
        "Correct the line, then try again.";
    CannotListen:
        "A virtual controller cannot listen on its port or serial line",
        "Another program on this computer uses the TCP port or the serial line, this account may not open it, or the address is not one of this computer.",
        "Stop the other program, or choose other ports with --management-port, --opcua-port, --remote-port and --remote-frames-port, another line with --remote-serial, or another address with --bind.";
    NoDisplay:
        "The window cannot be opened",
        "There is no display here, as in a session by SSH, or its graphics driver offers neither OpenGL 2.1 nor Direct3D 12, as in some remote desktop sessions and virtual machines.",
        "Start the program at the computer itself or over a remote desktop connection, install the graphics driver (on Linux, Mesa's software rendering is enough), or use the command line (--help).";
    NoFilePicker:
        "The file dialog cannot be opened",
        "This desktop offers none: a portal for files (xdg-desktop-portal) is missing.",
        "Type the path of the file into the field.";
    FolderNotOpened:
        "The folder cannot be opened",
        "This desktop has no program for it, or the folder is not there.",
        "Copy the path and open it by hand.";
    FileTooLarge:
        "The file is too large",
        "No file this program reads is that large.",
        "Check whether it is the right file.";
    FileNotRecognised:
        "The file is of no known kind",
        "It is neither a certificate, key, CSR or CRL, nor an activation file, connection list, settings export or recording.",
        "Check whether it is the right file and whether it is whole.";
    Cancelled:
        "Not started",
        "The operation was cancelled before this controller's turn.",
        "Run the operation again for the controllers that are missing.";
    Internal:
        "Something unexpected happened",
        "This is an error in the program or in the controller.",
        "Try again. If it happens again, report it with the detail shown.";
}
