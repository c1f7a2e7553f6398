//! The registry of errors: what a person reads about each, in English and Chinese (manual 6.1 and 6.2).

use super::{ErrorCode, Explanation};

const fn text(message: &'static str, cause: &'static str, remedy: &'static str) -> Explanation {
    Explanation { message, cause, remedy }
}

/// Code, English, Chinese.
pub(super) const REGISTRY: &[(ErrorCode, Explanation, Explanation)] = &[
    (
        ErrorCode::NotActivated,
        text(
            "The OPC UA server is not activated",
            "The controller has no valid OPC UA licence.",
            "Activate the OPC UA function, then start the server again.",
        ),
        text("OPC UA 服务器未激活", "控制器没有有效的 OPC UA 许可。", "请先激活 OPC UA 功能，然后重新启动服务器。"),
    ),
    (
        ErrorCode::NoCertificate,
        text(
            "No server certificate is configured",
            "The controller holds no certificate of the selected type.",
            "Create or import a server certificate, or select another certificate type.",
        ),
        text("未配置服务器证书", "控制器中没有所选类型的证书。", "请创建或导入服务器证书，或选择其他认证类型。"),
    ),
    (
        ErrorCode::InvalidParameter,
        text(
            "The OPC UA server has an invalid parameter",
            "A value in the server settings or in the server certificate does not fit.",
            "Check the basic settings and the server certificate.",
        ),
        text("OPC UA 服务器参数无效", "服务器设置或服务器证书中有不合适的值。", "请检查基本设置和服务器证书。"),
    ),
    (
        ErrorCode::PortConflict,
        text(
            "The port of the OPC UA server is already in use",
            "Another function of the controller uses the same TCP port.",
            "Choose another port in the basic settings.",
        ),
        text("OPC UA 服务器端口冲突", "控制器的其他功能正在使用同一 TCP 端口。", "请在基本设置中选择其他端口。"),
    ),
    (
        ErrorCode::ServerError,
        text(
            "The OPC UA server failed",
            "The server inside the controller met an internal error.",
            "Restart the controller. If it happens again, switch on the server log and send it to support.",
        ),
        text(
            "OPC UA 服务器错误",
            "控制器内的服务器发生内部错误。",
            "请重新启动控制器。若再次发生，请打开服务器日志并联系技术支持。",
        ),
    ),
    (
        ErrorCode::ServerLogOn,
        text(
            "The server log is switched on",
            "The OPC UA server writes its log, which fills the controller's storage in time.",
            "Switch the server log off in the basic settings, then restart the controller.",
        ),
        text(
            "OPC UA 服务器日志已打开",
            "服务器正在写日志，会逐渐占满控制器的存储空间。",
            "请在基本设置中关闭服务器日志，然后重新启动控制器。",
        ),
    ),
    (
        ErrorCode::ServerLogFull,
        text(
            "The server log is over its size limit",
            "The log file reached its limit and the OPC UA server stopped itself.",
            "Switch the server log off and delete it in the basic settings, then restart the controller.",
        ),
        text(
            "OPC UA 服务器日志超出大小限制",
            "日志文件达到上限，OPC UA 服务器已自行停止。",
            "请在基本设置中关闭并删除服务器日志，然后重新启动控制器。",
        ),
    ),
    (
        ErrorCode::Unreachable,
        text(
            "The controller cannot be reached",
            "It is switched off, the network cable is unplugged, or the address is wrong.",
            "Switch the controller on, check the cable and the address, then try again.",
        ),
        text("无法连接控制器", "控制器未打开、网线未连接或地址错误。", "请打开控制器，检查网线和地址，然后重试。"),
    ),
    (
        ErrorCode::Timeout,
        text(
            "The controller does not answer",
            "It accepted the connection but sent no answer in time.",
            "Wait until the controller has finished what it is doing, then try again. If it stays silent, restart it.",
        ),
        text(
            "控制器没有响应",
            "控制器接受了连接，但未在规定时间内响应。",
            "请等待控制器完成当前处理后重试。若仍无响应，请重新启动控制器。",
        ),
    ),
    (
        ErrorCode::ConnectionLost,
        text(
            "The connection was lost during the operation",
            "The network cable was pulled, or the controller was restarted, before the answer arrived.",
            "Check the connection, get new information to see what was done, then repeat what is missing.",
        ),
        text(
            "处理过程中连接断开",
            "在收到响应之前，网线断开或控制器被重新启动。",
            "请检查连接，点击[获取新信息]确认已完成的处理，然后重做未完成的部分。",
        ),
    ),
    (
        ErrorCode::AnswerLost,
        text(
            "The change was applied, but its answer was lost",
            "The connection broke after the change was sent. Read again, the controller shows that it was changed.",
            "Compare the row with what was wanted. Repeat the operation if something was to be saved on this computer.",
        ),
        text(
            "更改已生效，但未收到应答",
            "发送更改后连接中断。重新读取后确认控制器已更改。",
            "请核对该行的信息。若需要在本机保存文件，请重新执行该操作。",
        ),
    ),
    (
        ErrorCode::HandshakeLost,
        text(
            "The connection ended before encryption was agreed on",
            "The controller has too many connections at the moment, or the port belongs to another service.",
            "Try again in a minute. If it happens again, check the address and the port of the controller's management.",
        ),
        text(
            "连接在加密协商完成前中断",
            "控制器当前的连接过多，或该端口属于其他服务。",
            "请一分钟后重试。若再次发生，请检查控制器管理的地址和端口。",
        ),
    ),
    (
        ErrorCode::NotAController,
        text(
            "What answers at this address is not a controller",
            "Something answers, but not with the controller-management protocol.",
            "Check the address and the port. The port is that of the controller's management, not of its OPC UA server.",
        ),
        text(
            "该地址的设备不是控制器",
            "有设备响应，但不是控制器管理协议。",
            "请检查地址和端口。端口应为控制器的管理端口，而不是 OPC UA 服务器端口。",
        ),
    ),
    (
        ErrorCode::ProtocolVersion,
        text(
            "The controller speaks another version of the management protocol",
            "Its firmware is newer or older than this program supports.",
            "Update this program, or the controller's firmware.",
        ),
        text("控制器的管理协议版本不同", "固件版本比本程序支持的更新或更旧。", "请更新本程序或控制器固件。"),
    ),
    (
        ErrorCode::FingerprintChanged,
        text(
            "The controller's identity has changed",
            "The fingerprint is not the one confirmed when the controller was added. The controller was replaced, or \
             somebody is between you and it.",
            "Compare the fingerprint with the one the controller shows. If the change is right, delete the controller \
             and add it again; if not, tell your network administrator.",
        ),
        text(
            "控制器的身份已改变",
            "指纹与添加控制器时确认的不同。控制器可能已更换，或网络中有人冒充控制器。",
            "请与控制器上显示的指纹核对。若更改正确，请删除后重新添加该控制器；否则请联系网络管理员。",
        ),
    ),
    (
        ErrorCode::FingerprintUnknown,
        text(
            "The controller's fingerprint has not been confirmed",
            "A controller is only talked to once its fingerprint was compared and accepted.",
            "Compare the fingerprint with the one the controller shows, then confirm it.",
        ),
        text("尚未确认控制器的指纹", "只有核对并接受指纹后，才能与控制器通信。", "请与控制器上显示的指纹核对后确认。"),
    ),
    (
        ErrorCode::WrongPassword,
        text(
            "The connection password is wrong",
            "The controller did not accept the password for Ethernet connections.",
            "Enter the password that is set in the controller.",
        ),
        text("连接密码错误", "控制器未接受以太网连接密码。", "请输入控制器中设置的密码。"),
    ),
    (
        ErrorCode::PasswordMissing,
        text(
            "The connection password is not known",
            "It was not entered yet, or this computer has no keyring to keep it in.",
            "Enter the connection password of the controller. A vault keeps it without a keyring (Options, vault init).",
        ),
        text(
            "缺少连接密码",
            "尚未输入该密码，或本机没有可保存密码的密钥环。",
            "请输入控制器的连接密码。没有密钥环时，可用密码库保存密码（[选项]或 vault init）。",
        ),
    ),
    (
        ErrorCode::LockedOut,
        text(
            "The controller refuses further attempts for a while",
            "A wrong connection password was sent too often.",
            "Wait for a minute, then try again with the right password.",
        ),
        text("控制器暂时拒绝登录", "多次发送了错误的连接密码。", "请等待一分钟，然后使用正确的密码重试。"),
    ),
    (
        ErrorCode::SessionExpired,
        text(
            "The session with the controller has ended",
            "The controller was restarted or the session was idle for too long.",
            "Repeat the operation.",
        ),
        text("与控制器的会话已结束", "控制器已重新启动，或会话空闲时间过长。", "请重新操作。"),
    ),
    (
        ErrorCode::FirmwareNotSupported,
        text(
            "The controller's firmware does not support OPC UA",
            "The firmware is older than the first version with an OPC UA server.",
            "Update the firmware: RC90 and RC700 from 7.5.4, T/VT from 7.5.54, RC800 from 8.0.0.",
        ),
        text(
            "控制器固件版本不支持 OPC UA",
            "固件版本早于首个包含 OPC UA 服务器的版本。",
            "请更新固件：RC90、RC700 从 7.5.4 起，T/VT 从 7.5.54 起，RC800 从 8.0.0 起。",
        ),
    ),
    (
        ErrorCode::FirmwareTooNew,
        text(
            "This function is not available on firmware 8.0.0 or later",
            "The controller makes its keys itself and is activated as a controller option.",
            "Use the function that replaces it for current firmware.",
        ),
        text(
            "固件 8.0.0 及以上版本不提供此功能",
            "控制器自行生成密钥，并通过控制器选项激活。",
            "请使用新版固件对应的功能。",
        ),
    ),
    (
        ErrorCode::FirmwareTooOld,
        text(
            "This function needs firmware 8.0.0 or later",
            "The controller's firmware is older.",
            "Update the firmware, or leave this controller out.",
        ),
        text("此功能需要固件 8.0.0 或更高版本", "控制器固件版本较旧。", "请更新固件，或取消选择该控制器。"),
    ),
    (
        ErrorCode::TaskRunning,
        text(
            "A task is running in the controller",
            "The controller cannot be configured while it runs a program.",
            "Wait for the task to finish or stop it, then try again.",
        ),
        text("控制器正在运行任务", "任务运行中，无法配置控制器。", "请等待任务结束或停止任务，然后重试。"),
    ),
    (
        ErrorCode::TeachPendantConnected,
        text(
            "A teach pendant is connected to the controller",
            "The controller cannot be configured while a teach pendant has control.",
            "Disconnect the teach pendant, then try again.",
        ),
        text("控制器已连接示教器", "示教器控制期间，无法配置控制器。", "请断开示教器，然后重试。"),
    ),
    (
        ErrorCode::ChangedMeanwhile,
        text(
            "The controller was changed by somebody else",
            "Its configuration is newer than the one this change was based on. Nothing was changed.",
            "Get new information, check the settings, then make the change again.",
        ),
        text(
            "控制器已被他人更改",
            "控制器的配置比本次更改所依据的版本更新。未做任何更改。",
            "请获取新信息并检查设置，然后重新更改。",
        ),
    ),
    (
        ErrorCode::TooManyUsers,
        text(
            "The controller has the most users it can take",
            "A controller takes at most 10 users.",
            "Delete a user that is no longer needed, then add the new one.",
        ),
        text("用户数量已达上限", "每台控制器最多可注册 10 个用户。", "请删除不再需要的用户，然后再添加。"),
    ),
    (
        ErrorCode::UserExists,
        text(
            "A user of this name already exists",
            "The controller already has a user with the same name.",
            "Choose another name, or delete the existing user first.",
        ),
        text("用户名已存在", "控制器中已有同名用户。", "请使用其他名称，或先删除已有用户。"),
    ),
    (
        ErrorCode::UserNotFound,
        text(
            "The user does not exist",
            "The controller has no user of this name; it may have been deleted meanwhile.",
            "Open the user list again.",
        ),
        text("用户不存在", "控制器中没有该用户，可能已被删除。", "请重新打开用户列表。"),
    ),
    (
        ErrorCode::ListFull,
        text(
            "More certificates than the controller can take",
            "The list in the controller would grow over its limit. Nothing was sent.",
            "Delete certificates that are no longer needed, or add fewer.",
        ),
        text(
            "证书数量超过控制器上限",
            "控制器中的列表将超过上限。未发送任何内容。",
            "请删除不再需要的证书，或减少要添加的数量。",
        ),
    ),
    (
        ErrorCode::DuplicateCertificate,
        text(
            "The certificate is already in the list",
            "The controller already holds exactly this certificate.",
            "Nothing needs to be done.",
        ),
        text("证书已在列表中", "控制器中已有完全相同的证书。", "无需处理。"),
    ),
    (
        ErrorCode::NotInList,
        text(
            "The controller does not hold this any more",
            "The certificate or CRL is not in the list, or somebody else removed it meanwhile.",
            "List again to see what the controller holds now.",
        ),
        text(
            "控制器中已没有该项",
            "列表中没有该证书或 CRL，或已被他人删除。",
            "请重新显示列表，确认控制器中的当前内容。",
        ),
    ),
    (
        ErrorCode::NotAnAuthority,
        text(
            "The certificate is not one of an authority",
            "Only authorities, which sign other certificates, belong in the list of issuers.",
            "Add the certificate of an application to the trusted list.",
        ),
        text(
            "该证书不是颁发机构的证书",
            "发行人列表只接受签发其他证书的机构证书。",
            "请将应用程序的证书添加到信任列表。",
        ),
    ),
    (
        ErrorCode::TooManyCrls,
        text(
            "More CRLs than the controller can take",
            "The controller's room for CRLs would be exceeded. Nothing was sent.",
            "Delete CRLs that are no longer needed, or add fewer.",
        ),
        text(
            "CRL 超过控制器上限",
            "将超过控制器可保存的 CRL 上限。未发送任何内容。",
            "请删除不再需要的 CRL，或减少要添加的数量。",
        ),
    ),
    (
        ErrorCode::DuplicateCrl,
        text(
            "The controller already holds this CRL",
            "The controller holds exactly this CRL.",
            "Nothing needs to be done.",
        ),
        text("控制器中已有该 CRL", "控制器中已有完全相同的 CRL。", "无需处理。"),
    ),
    (
        ErrorCode::CrlOutdated,
        text(
            "The CRL is older than the one in the controller",
            "The controller holds a CRL of the same issuer that is as new or newer. With the older one, certificates revoked since would be valid again.",
            "Get the latest CRL from the issuer. If the older one is really meant, delete the newer one first.",
        ),
        text(
            "该 CRL 比控制器中的旧",
            "控制器中已有同一颁发者的相同版本或更新的 CRL。换成旧的会使此后吊销的证书重新有效。",
            "请向颁发者获取最新的 CRL。若确实需要旧的，请先删除较新的 CRL。",
        ),
    ),
    (
        ErrorCode::DiskFull,
        text(
            "The controller's storage is full",
            "The change could not be saved in the controller. Nothing was changed.",
            "Delete the server log or other files in the controller, then try again.",
        ),
        text(
            "控制器存储空间已满",
            "无法在控制器中保存更改。未做任何更改。",
            "请删除控制器中的服务器日志或其他文件，然后重试。",
        ),
    ),
    (
        ErrorCode::Refused,
        text(
            "The controller refused the operation",
            "The controller's own rules do not allow it in its present state.",
            "See the detail, then check the controller's state.",
        ),
        text("控制器拒绝了该操作", "控制器的当前状态不允许该操作。", "请查看详细信息并检查控制器状态。"),
    ),
    (
        ErrorCode::LogPassword,
        text(
            "The password for the server log is missing or wrong",
            "Switching the server log on needs the password 199532 (manual 2.6.1), so that nobody does it by mistake.",
            "Enter 199532. In normal use the server log stays off.",
        ),
        text(
            "缺少服务器日志密码或密码错误",
            "为防止误操作，打开服务器日志需要输入密码 199532（手册 2.6.1）。",
            "请输入 199532。正常使用时请保持服务器日志关闭。",
        ),
    ),
    (
        ErrorCode::RequestTooLarge,
        text(
            "The request is too large for the controller",
            "More data was sent than the controller accepts at once.",
            "Send fewer or smaller files.",
        ),
        text("请求过大", "发送的数据超过控制器一次可接收的大小。", "请减少文件数量或大小。"),
    ),
    (
        ErrorCode::UnknownSeries,
        text(
            "There is no controller series of this name",
            "The series are RC90, RC700, T/VT and RC800.",
            "Give one of them, as it stands on the controller.",
        ),
        text(
            "没有该名称的控制器类型",
            "控制器类型为 RC90、RC700、T/VT 和 RC800。",
            "请指定其中之一，与控制器上的标识一致。",
        ),
    ),
    (
        ErrorCode::NothingToChange,
        text(
            "Nothing to change was given",
            "The command changes only the settings that are given as options, and there are none.",
            "Give at least one option; --help lists them.",
        ),
        text(
            "未指定要更改的内容",
            "该命令仅更改以选项指定的设置，但未指定任何选项。",
            "请至少指定一个选项，--help 可查看全部选项。",
        ),
    ),
    (
        ErrorCode::UnknownComponent,
        text(
            "No component of this name is linked in",
            "The list of licences has no entry of this name.",
            "See the names with: opcua-configurator licences",
        ),
        text("没有该名称的组件", "许可证列表中没有该名称。", "请使用 opcua-configurator licences 查看名称。"),
    ),
    (
        ErrorCode::BadName,
        text(
            "The name cannot be used",
            "A name has 1 to 32 characters and no control characters.",
            "Enter another name.",
        ),
        text("名称无效", "名称须为 1 至 32 个字符，且不含控制字符。", "请输入其他名称。"),
    ),
    (
        ErrorCode::BadAddress,
        text(
            "The address is not valid",
            "An address is an IP address or a host name, with or without a port.",
            "Enter an address such as 192.168.0.1 or robot-7:7943.",
        ),
        text("地址无效", "地址须为 IP 地址或主机名，可带端口。", "请输入如 192.168.0.1 或 robot-7:7943 的地址。"),
    ),
    (
        ErrorCode::BadPort,
        text(
            "The port number must be between 0 and 65535",
            "The port is not a number, is out of range, or belongs to the system (0 to 1023).",
            "Enter a port from 1024 to 65535 in half-width digits.",
        ),
        text(
            "端口号必须介于 0 和 65535 之间",
            "端口不是数字、超出范围，或属于系统端口（0 至 1023）。",
            "请输入 1024 至 65535 的半角数字。",
        ),
    ),
    (
        ErrorCode::BadSettings,
        text(
            "The server settings are not complete",
            "At least one security policy and one user token policy must be chosen.",
            "Complete the settings.",
        ),
        text("服务器设置不完整", "至少须选择一种安全策略和一种用户令牌策略。", "请完成设置。"),
    ),
    (
        ErrorCode::BadCredential,
        text(
            "The user name or password is not allowed",
            "Both have 8 to 32 half-width letters and digits, no symbols.",
            "Enter another user name or password.",
        ),
        text("用户名或密码无效", "两者均须为 8 至 32 个半角字母或数字，不可使用符号。", "请重新输入用户名或密码。"),
    ),
    (
        ErrorCode::BadCertificateRequest,
        text(
            "A certificate field has a value that is not allowed",
            "Full-width characters, symbols outside the printable ones, or a value out of range were entered.",
            "Correct the field.",
        ),
        text("参数错误", "证书字段中输入了全角字符、不可用的符号或超出范围的值。", "请重新输入正确的值。"),
    ),
    (
        ErrorCode::BadCertificate,
        text(
            "The file holds no usable certificate",
            "It is damaged, or not an X.509 certificate in PEM or DER.",
            "Choose another file, or export the certificate again.",
        ),
        text(
            "文件中没有可用的证书",
            "文件已损坏，或不是 PEM、DER 格式的 X.509 证书。",
            "请选择其他文件，或重新导出证书。",
        ),
    ),
    (
        ErrorCode::BadCrl,
        text(
            "The file holds no usable CRL",
            "It is damaged, not a CRL in PEM or DER, or of a kind that controllers do not understand.",
            "Choose another file, or get the CRL from the issuer again.",
        ),
        text(
            "文件中没有可用的 CRL",
            "文件已损坏，不是 PEM、DER 格式的 CRL，或是控制器不支持的类型。",
            "请选择其他文件，或向颁发者重新获取 CRL。",
        ),
    ),
    (
        ErrorCode::BadFingerprint,
        text(
            "This is not a fingerprint",
            "A fingerprint is the SHA-256 of the controller's identity: 64 hexadecimal digits.",
            "Copy the fingerprint as the controller shows it.",
        ),
        text("指纹格式无效", "指纹是控制器身份的 SHA-256，为 64 位十六进制数字。", "请按控制器显示的内容复制指纹。"),
    ),
    (
        ErrorCode::NameTaken,
        text("Another controller already has this name", "Names in the list are unique.", "Choose another name."),
        text("名称已被使用", "列表中的名称不可重复。", "请使用其他名称。"),
    ),
    (
        ErrorCode::AddressTaken,
        text(
            "Another controller already has this address",
            "The same address and port are registered under another name.",
            "Check the address, or delete the other entry.",
        ),
        text("地址已被使用", "相同的地址和端口已以其他名称注册。", "请检查地址，或删除另一条目。"),
    ),
    (
        ErrorCode::UnknownController,
        text(
            "No controller of this name is in the list",
            "The name is mistyped, or the controller was added in another workspace.",
            "See the list of controllers for the names.",
        ),
        text("列表中没有该名称的控制器", "名称输入错误，或该控制器在其他工作区中。", "请在控制器列表中确认名称。"),
    ),
    (
        ErrorCode::FileUnreadable,
        text(
            "The file cannot be read",
            "It does not exist, or this account may not read it.",
            "Check the file's name and its permissions.",
        ),
        text("无法读取文件", "文件不存在，或当前账户没有读取权限。", "请检查文件名和权限。"),
    ),
    (
        ErrorCode::NotConfirmed,
        text(
            "The operation was not confirmed",
            "It stops, replaces or deletes something, or there is something to think about first, and there is no terminal to ask on.",
            "Repeat the command with --yes.",
        ),
        text(
            "操作未确认",
            "该操作会停止、替换或删除某些内容，或有需要先考虑的事项，且没有可询问的终端。",
            "请加上 --yes 重新执行命令。",
        ),
    ),
    (
        ErrorCode::CsrMismatch,
        text(
            "The certificate and the CSR do not match",
            "The certificate was not issued for the CSR that the controller holds.",
            "Import the certificate that the CA issued for this controller's latest CSR.",
        ),
        text(
            "证书和 CSR 不匹配",
            "控制器中保存的 CSR 与待导入证书未配对。",
            "请导入 CA 为该控制器最新的 CSR 签发的证书。",
        ),
    ),
    (
        ErrorCode::NoCsr,
        text(
            "The controller holds no CSR",
            "A CA-signed certificate can only be imported for a CSR that was made before.",
            "Create a CSR, have it signed by the CA, then import the certificate.",
        ),
        text("控制器中没有 CSR", "只有先创建 CSR，才能导入 CA 签名证书。", "请创建 CSR 并由 CA 签发证书，然后再导入。"),
    ),
    (
        ErrorCode::CertificateNotStored,
        text(
            "The controller holds no certificate of this type",
            "None was created or imported yet, or it was removed.",
            "Create or import the certificate first.",
        ),
        text("控制器中没有该类型的证书", "尚未创建或导入该类型的证书，或已被删除。", "请先创建或导入证书。"),
    ),
    (
        ErrorCode::CertificateExpired,
        text(
            "The certificate has expired",
            "Its validity ended before the date of the controller's clock.",
            "Have a new certificate issued. If the controller's clock is wrong, set it.",
        ),
        text("证书已过期", "证书的有效期早于控制器的当前日期。", "请重新签发证书。若控制器时钟有误，请先校准时钟。"),
    ),
    (
        ErrorCode::KeyLengthNotAllowed,
        text(
            "The key length does not fit the security policies",
            "One of the ticked security policies does not allow keys of this length.",
            "Use a certificate with another key length, or change the security policies in the basic settings.",
        ),
        text(
            "密钥长度与安全策略不符",
            "所选的某个安全策略不允许该密钥长度。",
            "请使用其他密钥长度的证书，或在基本设置中更改安全策略。",
        ),
    ),
    (
        ErrorCode::KeyMismatch,
        text(
            "The certificate and the private key are not a pair",
            "The certificate was issued for another key.",
            "Choose the key and the certificate that belong together.",
        ),
        text("证书与私钥不匹配", "该证书是为其他私钥签发的。", "请选择配对的证书和私钥。"),
    ),
    (
        ErrorCode::WrongKeyPassword,
        text(
            "The password of the private key is wrong",
            "The file cannot be opened with this password, or none was given. Where the file does not allow to tell, it \
             may also be damaged.",
            "Enter the password that was set when the file was made.",
        ),
        text(
            "输入的密码不正确",
            "无法使用该密码打开文件，或未输入密码。文件也可能已损坏。",
            "请重新输入创建文件时设置的密码。",
        ),
    ),
    (
        ErrorCode::FileNotFound,
        text(
            "The file to be imported was not found",
            "There is no such file in the import folder of this controller.",
            "Put the file into the folder named in the detail.",
        ),
        text("找不到导入文件", "在该控制器的导入源文件夹中没有要导入的文件。", "请将文件放入详细信息所示的文件夹。"),
    ),
    (
        ErrorCode::SeveralFiles,
        text(
            "More files than can be imported",
            "The import folder holds several files of this kind; exactly one is expected.",
            "Leave only the file that is to be imported in the folder.",
        ),
        text(
            "尝试导入超过限制的文件",
            "导入源文件夹中有多个此类文件，只能有一个。",
            "请在文件夹中仅保留要导入的文件。",
        ),
    ),
    (
        ErrorCode::BadFileName,
        text(
            "The file name cannot be used",
            "It contains characters other than half-width letters, digits and underscores, or Windows keeps the name for \
             itself: CON, NUL, COM1, names that end with a dot or a blank.",
            "Rename the file or the folder.",
        ),
        text(
            "文件名错误",
            "文件名中使用了除半角字母数字和下划线以外的字符，或为 Windows 保留的名称（CON、NUL、COM1，以及以点或空格结尾的名称）。",
            "请更改文件名或文件夹名。",
        ),
    ),
    (
        ErrorCode::FileFormat,
        text(
            "The file has the wrong format",
            "Its content is damaged, or is not what was chosen to be imported.",
            "See the detail, then convert or export the file again.",
        ),
        text("文件格式无效", "文件已损坏，或与所选的文件格式不一致。", "请查看详细信息，然后转换或重新导出文件。"),
    ),
    (
        ErrorCode::OneControllerOnly,
        text(
            "This works on one controller at a time",
            "What was given belongs to one controller: each has keys and a certificate of its own.",
            "Choose one controller only.",
        ),
        text(
            "此功能一次只能用于一台控制器",
            "指定的内容仅属于一台控制器：每台控制器有各自的密钥和证书。",
            "请只选择一台控制器。",
        ),
    ),
    (
        ErrorCode::Preflight,
        text(
            "OPC UA clients would refuse the certificate",
            "It does not fit the controller it is meant for. Nothing was sent.",
            "See the detail for what is wrong, then have the certificate issued again.",
        ),
        text(
            "OPC UA 客户端将拒绝该证书",
            "证书与目标控制器不相符。未发送任何内容。",
            "请查看详细信息，然后重新签发证书。",
        ),
    ),
    (
        ErrorCode::PreflightWarnings,
        text(
            "Some OPC UA clients may complain about the certificate",
            "It can be used, but not everything about it is as it should be. Nothing was sent.",
            "See the detail, then have the certificate issued again, or import it all the same (command line: --accept-warnings).",
        ),
        text(
            "部分 OPC UA 客户端可能对该证书发出警告",
            "证书可以使用，但并非完全符合要求。未发送任何内容。",
            "请查看详细信息，然后重新签发证书，或确认后继续导入 (命令行：--accept-warnings)。",
        ),
    ),
    (
        ErrorCode::NoAuthority,
        text(
            "There is no certificate authority in this workspace",
            "The small CA has not been created yet, or another workspace is open.",
            "Create the CA first, or restore it from a backup.",
        ),
        text("工作区中没有证书颁发机构", "尚未创建小型 CA，或打开了其他工作区。", "请先创建 CA，或从备份恢复。"),
    ),
    (
        ErrorCode::AuthorityExists,
        text(
            "The workspace has a certificate authority already",
            "A workspace holds one CA. Another one would make everything it signed worthless.",
            "Use the one that is there, or another workspace. To start anew, move its folder away first.",
        ),
        text(
            "工作区中已有证书颁发机构",
            "一个工作区只能有一个 CA。另建 CA 会使已签发的证书全部失效。",
            "请使用现有的 CA 或其他工作区。若要重新创建，请先移走 CA 文件夹。",
        ),
    ),
    (
        ErrorCode::AuthorityBusy,
        text(
            "The certificate authority is in use",
            "Another window or command is working with the CA of this workspace.",
            "Wait until it has finished, then try again.",
        ),
        text("证书颁发机构正在使用中", "其他窗口或命令正在使用该工作区的 CA。", "请等待其完成，然后重试。"),
    ),
    (
        ErrorCode::AuthorityDamaged,
        text(
            "The files of the certificate authority are damaged",
            "The database, the certificate or the key of the CA is missing, cut short or was changed. Nothing was \
             written to it.",
            "Move the CA's folder away and restore it from a backup.",
        ),
        text(
            "证书颁发机构的文件已损坏",
            "CA 的数据库、证书或密钥缺失、不完整或已被修改。未写入任何内容。",
            "请移走 CA 文件夹，然后从备份恢复。",
        ),
    ),
    (
        ErrorCode::AuthorityPassphrase,
        text(
            "The passphrase of the certificate authority is wrong",
            "The passphrase does not open the CA's key, or the key file is damaged.",
            "Enter the passphrase that was chosen when the CA was created.",
        ),
        text("证书颁发机构的口令错误", "口令无法打开 CA 密钥，或密钥文件已损坏。", "请输入创建 CA 时设置的口令。"),
    ),
    (
        ErrorCode::NoPassphrase,
        text(
            "No passphrase was given",
            "There is no terminal to ask for it, or the two entries differ.",
            "Name a file with --passphrase-file, or enter the same passphrase twice.",
        ),
        text(
            "未输入口令",
            "没有可询问的终端，或两次输入的口令不一致。",
            "请用 --passphrase-file 指定文件，或两次输入相同的口令。",
        ),
    ),
    (
        ErrorCode::AuthorityExpired,
        text(
            "The certificate authority is not valid now",
            "Its certificate has expired, or this computer's clock is wrong. Nothing it signs would be accepted.",
            "Check the clock. If the CA has expired, create a new one and have all certificates signed by it.",
        ),
        text(
            "证书颁发机构当前无效",
            "CA 证书已过期，或本机时钟有误。其签发的内容不会被接受。",
            "请检查时钟。若 CA 已过期，请创建新的 CA 并重新签发所有证书。",
        ),
    ),
    (
        ErrorCode::CsrRefused,
        text(
            "The certificate authority does not sign this request",
            "The certificate signing request lacks something OPC UA needs, or asks for something that does not belong \
             into a certificate.",
            "See the detail, then make the request again with the right names.",
        ),
        text(
            "证书颁发机构拒绝签发该请求",
            "CSR 缺少 OPC UA 所需的内容，或包含不应写入证书的内容。",
            "请查看详细信息，使用正确的名称重新创建 CSR。",
        ),
    ),
    (
        ErrorCode::ShortKey,
        text(
            "The key of the signing request is too short",
            "Keys below 2048 bits are for deprecated security policies only and can be broken.",
            "Make the request again with a longer key, or allow short keys if the controller needs one.",
        ),
        text(
            "CSR 的密钥过短",
            "低于 2048 位的密钥仅用于已弃用的安全策略，可能被破解。",
            "请使用更长的密钥重新创建 CSR；若控制器确实需要，请允许使用短密钥。",
        ),
    ),
    (
        ErrorCode::AlreadySigned,
        text(
            "There is a valid certificate for this request",
            "The CA signed the same key before, and that certificate is neither revoked nor expired.",
            "Use that certificate, or ask for a renewal.",
        ),
        text(
            "该请求已有有效的证书",
            "CA 已为同一密钥签发过证书，且该证书未吊销也未过期。",
            "请使用该证书，或选择续签。",
        ),
    ),
    (
        ErrorCode::UnknownSerial,
        text(
            "The certificate authority has not issued this certificate",
            "No certificate with this serial number is in its database.",
            "Compare the serial number with the list of issued certificates.",
        ),
        text("证书颁发机构未签发过该证书", "数据库中没有该序列号的证书。", "请与已签发证书列表核对序列号。"),
    ),
    (
        ErrorCode::AlreadyRevoked,
        text(
            "The certificate has been revoked already",
            "A revocation cannot be changed or taken back.",
            "Publish the CRL so that everybody learns of it.",
        ),
        text("证书已被吊销", "吊销后不能更改或撤回。", "请发布 CRL 以通知各方。"),
    ),
    (
        ErrorCode::BackupDamaged,
        text(
            "The file is no whole backup of a certificate authority",
            "It is cut short or was changed, of a newer version, or another file altogether.",
            "Choose another copy of the backup.",
        ),
        text(
            "该文件不是完整的证书颁发机构备份",
            "文件不完整、已被修改、版本更新，或是其他文件。",
            "请选择该备份的其他副本。",
        ),
    ),
    (
        ErrorCode::BackupPassphrase,
        text(
            "The passphrase does not open the backup",
            "The backup was made with another passphrase, or was changed since.",
            "Enter the passphrase the CA had when the backup was made.",
        ),
        text("口令无法打开备份", "备份时使用了其他口令，或备份已被修改。", "请输入备份时 CA 的口令。"),
    ),
    (
        ErrorCode::VerifyFailed,
        text(
            "Not everything the OPC UA server offers works",
            "Connecting as an OPC UA client failed in at least one way, or something about the server is wrong.",
            "Do what the report says for each failure, then verify again.",
        ),
        text(
            "OPC UA 服务器提供的连接方式并非全部正常",
            "以 OPC UA 客户端方式连接时至少有一种失败，或服务器存在问题。",
            "请按报告中的说明处理，然后重新验证。",
        ),
    ),
    (
        ErrorCode::WrongKeys,
        text(
            "The controller does not accept the keys",
            "The licence key or the activation key was made for another serial number, or has a typing mistake.",
            "Compare both keys with what the supplier sent for this serial number.",
        ),
        text(
            "控制器不接受该密钥",
            "许可密钥或激活密钥属于其他序列号，或输入有误。",
            "请与供应商针对该序列号提供的密钥核对。",
        ),
    ),
    (
        ErrorCode::NotInFile,
        text(
            "The activation file has no keys for this controller",
            "No good line of the file carries the controller's serial number.",
            "Add the line or correct it, or choose the file that belongs to this controller.",
        ),
        text(
            "激活文件中没有该控制器的信息",
            "文件中没有包含该控制器序列号的有效行。",
            "请在文件中添加或更正该行，或选择对应的文件。",
        ),
    ),
    (
        ErrorCode::BadActivationKey,
        text(
            "The licence key or the activation key is incomplete",
            "A licence key has 16 half-width letters and digits, an activation key 24.",
            "Enter the keys as the supplier sent them.",
        ),
        text(
            "许可密钥或激活密钥不完整",
            "许可密钥为 16 个半角字母或数字，激活密钥为 24 个。",
            "请按供应商提供的内容输入密钥。",
        ),
    ),
    (
        ErrorCode::BadActivationFile,
        text(
            "The file is not an activation file",
            "It is not UTF-8 text, or its first line is not OPCUA.Activation.Ver.1.0.",
            "Choose another file, or save it again as CSV in UTF-8 with that first line.",
        ),
        text(
            "文件格式无效，不是激活文件",
            "文件不是 UTF-8 文本，或第一行不是 OPCUA.Activation.Ver.1.0。",
            "请选择其他文件，或以该内容为第一行，重新保存为 UTF-8 编码的 CSV。",
        ),
    ),
    (
        ErrorCode::BadConnectionList,
        text(
            "This is not a connection list, or not a line of one",
            "A connection list is a CSV file in UTF-8 with the columns Name, Type and Address.",
            "Choose another file, or correct the line.",
        ),
        text(
            "文件或其中一行不是有效的连接列表",
            "连接列表是 UTF-8 编码的 CSV 文件，包含 Name、Type、Address 三列。",
            "请选择其他文件，或更正该行。",
        ),
    ),
    (
        ErrorCode::ExportMissing,
        text(
            "No settings were exported from this controller",
            "The controller's folder in the workspace holds no option.json.",
            "Export the settings first, or copy the exported file into the folder named by the serial number.",
        ),
        text(
            "找不到导入文件",
            "工作区的控制器文件夹中没有 option.json。",
            "请先导出设置，或将导出的文件放入以序列号命名的文件夹中。",
        ),
    ),
    (
        ErrorCode::ExportRenamed,
        text(
            "The name of the exported file was changed",
            "Settings are imported from the file option.json only.",
            "Give the file its name back.",
        ),
        text("文件名错误", "只能从 option.json 导入设置，导出文件的名称已被修改。", "请恢复文件名。"),
    ),
    (
        ErrorCode::ExportOfAnother,
        text(
            "The exported settings belong to another controller",
            "The file was exported from a controller with another serial number or of another series.",
            "Put each file back into the folder named by its controller's serial number.",
        ),
        text(
            "导出的设置属于其他控制器",
            "该文件来自序列号或系列不同的控制器。",
            "请将各文件放回以其控制器序列号命名的文件夹中。",
        ),
    ),
    (
        ErrorCode::ExportVersion,
        text(
            "The exported settings are of another version",
            "The file has a format this program does not know, or comes from newer firmware than the controller's.",
            "Update this program or the controller's firmware, or export the settings again.",
        ),
        text(
            "导出的设置版本不同",
            "文件格式不是本程序支持的版本，或来自比控制器更新的固件。",
            "请更新本程序或控制器固件，或重新导出设置。",
        ),
    ),
    (
        ErrorCode::ExportDamaged,
        text(
            "The exported settings are damaged",
            "The file is cut short or was changed, or it is not a settings export.",
            "Restore the file from a copy, or export the settings again.",
        ),
        text(
            "导出的设置文件已损坏",
            "文件不完整或已被修改，或不是导出的设置文件。",
            "请从副本恢复该文件，或重新导出设置。",
        ),
    ),
    (
        ErrorCode::WrongPassphrase,
        text(
            "The passphrase does not open the exported settings",
            "They were sealed with another passphrase, or with the connection password the controller had then.",
            "Enter the passphrase of the export.",
        ),
        text("口令无法打开导出的设置", "导出时使用了其他口令，或当时控制器的连接密码。", "请输入导出时使用的口令。"),
    ),
    (
        ErrorCode::BadPassphrase,
        text(
            "The passphrase is too short",
            "A passphrase that protects an export or a CA has at least 8 characters.",
            "Choose a longer passphrase.",
        ),
        text("口令过短", "保护导出文件或 CA 的口令至少为 8 个字符。", "请使用更长的口令。"),
    ),
    (
        ErrorCode::UnprotectedFile,
        text(
            "The connection password is empty and protects no file",
            "A backup of a key, and an export of settings without a passphrase, are protected by the connection password \
             of the controller. With an empty one everybody who can read the file could open it, so nothing was changed.",
            "For an export, give a passphrase. For a backup of keys, set a connection password in the controller, or \
             switch the backup off.",
        ),
        text(
            "连接密码为空，无法保护文件",
            "密钥备份以及未设口令的设置导出文件由控制器的连接密码保护。连接密码为空时，任何能读取该文件的人都能打开，因此未做任何更改。",
            "导出时请输入口令。备份密钥时，请在控制器中设置连接密码，或关闭备份。",
        ),
    ),
    (
        ErrorCode::WorkspaceReadOnly,
        text(
            "The workspace cannot be written",
            "This account may not write into the workspace folder.",
            "Change the folder's permissions, or choose another workspace with --workspace.",
        ),
        text(
            "无法写入工作区",
            "当前账户没有工作区文件夹的写入权限。",
            "请更改文件夹权限，或使用 --workspace 选择其他工作区。",
        ),
    ),
    (
        ErrorCode::WorkspaceFull,
        text(
            "The disk of the workspace is full",
            "The file could not be written completely and was left as it was before.",
            "Free some space, then try again.",
        ),
        text("工作区所在磁盘已满", "文件未能完整写入，已保持原样。", "请释放磁盘空间，然后重试。"),
    ),
    (
        ErrorCode::WorkspaceBusy,
        text(
            "The workspace is open in another window",
            "Only one instance of the program works on a workspace at a time.",
            "Use the other window, or close it first.",
        ),
        text("工作区已在其他窗口中打开", "同一工作区同时只能由一个程序使用。", "请使用已打开的窗口，或先将其关闭。"),
    ),
    (
        ErrorCode::FileInUse,
        text(
            "A file is in use by another program",
            "Another program has the file open, such as a virus scanner, a backup, a spreadsheet or an editor.",
            "Close the file in the other program, then try again; until then the file keeps its old content.",
        ),
        text(
            "文件正被其他程序使用",
            "另一个程序打开了该文件，例如杀毒软件、备份程序、电子表格或编辑器。",
            "请在该程序中关闭文件后重试；在此之前文件保持原有内容。",
        ),
    ),
    (
        ErrorCode::ConfigurationDamaged,
        text(
            "The configuration file was damaged",
            "It could not be read as a configuration. It was kept under another name, and an empty one is used.",
            "Restore the controllers from a backup of the file, or add them again.",
        ),
        text(
            "配置文件已损坏",
            "无法将其作为配置读取。已另名保留，并使用空配置。",
            "请从备份恢复该文件，或重新添加控制器。",
        ),
    ),
    (
        ErrorCode::KeyringUnavailable,
        text(
            "The password cannot be kept on this computer",
            "There is no operating-system keyring, or it is locked.",
            "Unlock the keyring, create a vault for passwords (Options, vault init), or enter the password at each start.",
        ),
        text(
            "本机无法保存密码",
            "没有操作系统密钥环，或密钥环已锁定。",
            "请解锁密钥环，或创建密码库（[选项]或 vault init），或在每次启动时输入密码。",
        ),
    ),
    (
        ErrorCode::VaultMissing,
        text(
            "There is no vault for passwords",
            "This workspace has no vault: none was created, or its file was moved or deleted.",
            "Create one (Options, vault init), or restore the file.",
        ),
        text(
            "没有密码库",
            "该工作区没有密码库：尚未创建，或其文件已被移动或删除。",
            "请创建密码库（[选项]或 vault init），或恢复该文件。",
        ),
    ),
    (
        ErrorCode::VaultExists,
        text(
            "There is a vault already",
            "A workspace has one vault for passwords, and it is not replaced.",
            "Open the vault that is there. To start anew, move its file away first.",
        ),
        text(
            "密码库已存在",
            "一个工作区只有一个密码库，不会被替换。",
            "请打开现有密码库。如需重新创建，请先移走其文件。",
        ),
    ),
    (
        ErrorCode::VaultLocked,
        text(
            "The vault for passwords is not open",
            "Its passphrase was not entered, or was changed by another program since.",
            "Enter the passphrase of the vault (--vault-passphrase-file), or the connection password.",
        ),
        text(
            "密码库未打开",
            "尚未输入密码库口令，或口令已被其他程序更改。",
            "请输入密码库口令（--vault-passphrase-file），或输入连接密码。",
        ),
    ),
    (
        ErrorCode::VaultPassphrase,
        text(
            "The passphrase does not open the vault",
            "The passphrase is wrong.",
            "Enter the passphrase that was chosen for the vault of this workspace.",
        ),
        text("口令无法打开密码库", "口令错误。", "请输入为该工作区密码库设置的口令。"),
    ),
    (
        ErrorCode::VaultDamaged,
        text(
            "The vault for passwords is damaged",
            "Its file was changed, cut off or replaced. It is left as it is.",
            "Restore the file from a backup. To start anew, move it away and create a vault.",
        ),
        text(
            "密码库已损坏",
            "其文件被更改、截断或替换。该文件保持原样。",
            "请从备份恢复该文件。如需重新创建，请先移走该文件。",
        ),
    ),
    (
        ErrorCode::VaultVersion,
        text(
            "The vault is of a later version",
            "It was written by a later version of this program. It is left as it is.",
            "Update this program.",
        ),
        text("密码库版本过新", "该密码库由更新版本的程序写入。文件保持原样。", "请更新本程序。"),
    ),
    (
        ErrorCode::VaultFull,
        text(
            "The password does not fit into the vault",
            "A vault holds at most 20,000 passwords of at most 1,024 bytes each.",
            "Take passwords that are not needed out of it (vault forget), or use a shorter password.",
        ),
        text(
            "密码库无法存入该密码",
            "密码库最多保存 20,000 个密码，每个不超过 1,024 字节。",
            "请删除不需要的密码（vault forget），或使用较短的密码。",
        ),
    ),
    (
        ErrorCode::BadPasswordList,
        text(
            "The file is not a list of connection passwords",
            "It is a CSV file with the columns Name,Password, one controller a line.",
            "Correct the line, then try again.",
        ),
        text(
            "该文件不是连接密码列表",
            "应为包含 Name,Password 两列的 CSV 文件，每行一个控制器。",
            "请更正该行，然后重试。",
        ),
    ),
    (
        ErrorCode::CannotListen,
        text(
            "A virtual controller cannot listen on its port",
            "Another program on this computer uses the TCP port, this account may not open it, or the address is not one of \
             this computer.",
            "Stop the other program, or choose other ports with --management-port and --opcua-port, or another address with --bind.",
        ),
        text(
            "虚拟控制器无法监听端口",
            "本机的其他程序正在使用该 TCP 端口、当前账户无权打开该端口，或该地址不属于本机。",
            "请停止占用端口的程序，或使用 --management-port 和 --opcua-port 选择其他端口、使用 --bind 选择其他地址。",
        ),
    ),
    (
        ErrorCode::NoDisplay,
        text(
            "The window cannot be opened",
            "There is no display here, as in a session by SSH, or its graphics driver offers neither OpenGL 2.1 nor \
             Direct3D 12, as in some remote desktop sessions and virtual machines.",
            "Start the program at the computer itself or over a remote desktop connection, install the graphics driver \
             (on Linux, Mesa's software rendering is enough), or use the command line (--help).",
        ),
        text(
            "无法打开窗口",
            "此处没有显示器（例如 SSH 会话），或图形驱动既不支持 OpenGL 2.1 也不支持 Direct3D 12（例如某些远程桌面会话和虚拟机）。",
            "请在电脑本机或通过远程桌面启动程序，安装图形驱动程序（Linux 上使用 Mesa 软件绘图即可），或使用命令行（--help）。",
        ),
    ),
    (
        ErrorCode::NoFilePicker,
        text(
            "The file dialog cannot be opened",
            "This desktop offers none: a portal for files (xdg-desktop-portal) is missing.",
            "Type the path of the file into the field.",
        ),
        text(
            "无法打开文件选择对话框",
            "当前桌面环境未提供文件选择功能（缺少 xdg-desktop-portal）。",
            "请在输入框中直接输入文件路径。",
        ),
    ),
    (
        ErrorCode::FolderNotOpened,
        text(
            "The folder cannot be opened",
            "This desktop has no program for it, or the folder is not there.",
            "Copy the path and open it by hand.",
        ),
        text("无法打开文件夹", "桌面环境没有可用的文件管理器，或文件夹不存在。", "请复制路径后手动打开。"),
    ),
    (
        ErrorCode::FileTooLarge,
        text(
            "The file is too large",
            "No file this program reads is that large.",
            "Check whether it is the right file.",
        ),
        text("文件过大", "本程序可读取的文件都没有这么大。", "请检查文件是否正确。"),
    ),
    (
        ErrorCode::FileNotRecognised,
        text(
            "The file is of no known kind",
            "It is neither a certificate, key, CSR or CRL, nor an activation file, connection list or settings export.",
            "Check whether it is the right file and whether it is whole.",
        ),
        text(
            "无法识别文件类型",
            "该文件不是证书、私钥、CSR、CRL、激活文件、连接列表或设置导出文件。",
            "请检查文件是否正确、完整。",
        ),
    ),
    (
        ErrorCode::Cancelled,
        text(
            "Not started",
            "The operation was cancelled before this controller's turn.",
            "Run the operation again for the controllers that are missing.",
        ),
        text("未开始", "在轮到该控制器之前已取消操作。", "请对未处理的控制器重新操作。"),
    ),
    (
        ErrorCode::Internal,
        text(
            "Something unexpected happened",
            "This is an error in the program or in the controller.",
            "Try again. If it happens again, report it with the detail shown.",
        ),
        text("发生意外错误", "程序或控制器内部出错。", "请重试。若再次发生，请附上详细信息进行报告。"),
    ),
];
