//! An authority made with the command line of OpenSSL, and the clients and servers it issues certificates to.

use std::fs;
use std::path::{Path, PathBuf};

use super::peers::{ClientCertificate, OpenSsl};

/// Who a certificate is for. The application URI is `urn:interop:<name>`.
pub struct Application {
    pub name: String,
    pub files: ClientCertificate,
}

impl Application {
    pub fn uri(&self) -> String {
        uri(&self.name)
    }

    /// With a certificate it signed itself.
    pub fn self_signed(openssl: &OpenSsl, folder: &Path, name: &str) -> Self {
        let files = in_folder(folder, name);
        let (san, key, out) = (names(&uri(name)), path(&files.key), path(&files.certificate));
        let make = ["req", "-x509", "-newkey", "rsa:2048", "-nodes", "-keyout", key, "-out", out, "-days", "30"];
        let usage = "keyUsage=critical,digitalSignature,nonRepudiation,keyEncipherment,dataEncipherment,keyCertSign";
        let extensions = ["-addext", &san, "-addext", usage, "-addext", "extendedKeyUsage=clientAuth,serverAuth"];
        let end = ["-addext", "basicConstraints=critical,CA:FALSE", "-subj", &format!("/CN={name}")];
        openssl.call(folder, &[&make[..], &extensions, &end].concat());
        Self { name: name.to_owned(), files }
    }

    /// A key, and a request for a certificate.
    pub fn request(openssl: &OpenSsl, folder: &Path, name: &str) -> (Self, PathBuf) {
        let files = in_folder(folder, name);
        let request = folder.join(format!("{name}.csr"));
        let (san, subject) = (names(&uri(name)), format!("/CN={name}"));
        let new = ["req", "-new", "-newkey", "rsa:2048", "-nodes", "-keyout", path(&files.key), "-out", path(&request)];
        openssl.call(folder, &[&new[..], &["-subj", &subject, "-addext", &san]].concat());
        (Self { name: name.to_owned(), files }, request)
    }
}

/// `openssl ca` in a folder of its own.
pub struct Authority<'a> {
    openssl: &'a OpenSsl,
    folder: PathBuf,
}

impl<'a> Authority<'a> {
    pub fn root(openssl: &'a OpenSsl, parent: &Path, name: &str) -> Self {
        let ca = Self::prepare(openssl, parent, name);
        let new = ["req", "-x509", "-config", "ca.cnf", "-extensions", "authority", "-newkey", "rsa:2048", "-nodes"];
        let to = ["-keyout", "ca.key", "-out", "ca.pem", "-days", "3650", "-subj", &format!("/CN={name}")];
        openssl.call(&ca.folder, &[&new[..], &to].concat());
        ca
    }

    /// An authority below this one.
    pub fn below(&self, name: &str) -> Self {
        let ca = Self::prepare(self.openssl, &self.folder, name);
        let request = ["req", "-new", "-newkey", "rsa:2048", "-nodes", "-keyout", "ca.key", "-out", "ca.csr", "-subj"];
        self.openssl.call(&ca.folder, &[&request[..], &[&format!("/CN={name}")]].concat());
        self.sign(&ca.folder.join("ca.csr"), &ca.certificate(), "authority", &[]);
        ca
    }

    pub fn certificate(&self) -> PathBuf {
        self.folder.join("ca.pem")
    }

    pub fn issue(&self, name: &str) -> Application {
        self.issue_with(name, &[])
    }

    /// A certificate that was valid once.
    pub fn issue_expired(&self, name: &str) -> Application {
        self.issue_with(name, &["-startdate", "20200101000000Z", "-enddate", "20210101000000Z"])
    }

    fn issue_with(&self, name: &str, dates: &[&str]) -> Application {
        let (application, request) = Application::request(self.openssl, &self.folder, name);
        self.sign(&request, &application.files.certificate, "leaf", dates);
        application
    }

    pub fn revoke(&self, application: &Application) {
        let certificate = path(&application.files.certificate);
        self.openssl.call(&self.folder, &["ca", "-config", "ca.cnf", "-revoke", certificate]);
    }

    /// A new CRL, in a file of its own.
    pub fn crl(&self) -> PathBuf {
        let number = fs::read_to_string(self.folder.join("crlnumber")).expect("kept by openssl ca");
        let file = self.folder.join(format!("{}.crl.pem", number.trim()));
        self.openssl.call(&self.folder, &["ca", "-config", "ca.cnf", "-gencrl", "-out", path(&file)]);
        file
    }

    fn sign(&self, request: &Path, out: &Path, extensions: &str, dates: &[&str]) {
        let sign = ["ca", "-batch", "-config", "ca.cnf", "-notext", "-extensions", extensions];
        self.openssl.call(&self.folder, &[&sign[..], dates, &["-in", path(request), "-out", path(out)]].concat());
    }

    fn prepare(openssl: &'a OpenSsl, parent: &Path, name: &str) -> Self {
        let folder = parent.join(name);
        fs::create_dir_all(&folder).expect("a folder");
        for (file, content) in
            [("ca.cnf", CONFIGURATION), ("index.txt", ""), ("serial", "1000\n"), ("crlnumber", "01\n")]
        {
            fs::write(folder.join(file), content).expect("a file");
        }
        Self { openssl, folder }
    }
}

const CONFIGURATION: &str = "
[req]
distinguished_name = name
[name]
[ca]
default_ca = plant
[plant]
certificate = ca.pem
private_key = ca.key
database = index.txt
new_certs_dir = .
serial = serial
crlnumber = crlnumber
default_md = sha256
default_days = 365
default_crl_days = 7
unique_subject = no
copy_extensions = copy
policy = policy
crl_extensions = crl
[policy]
commonName = supplied
[authority]
basicConstraints = critical, CA:TRUE
keyUsage = critical, keyCertSign, cRLSign
subjectKeyIdentifier = hash
[leaf]
basicConstraints = critical, CA:FALSE
keyUsage = critical, digitalSignature, nonRepudiation, keyEncipherment, dataEncipherment
extendedKeyUsage = clientAuth, serverAuth
subjectKeyIdentifier = hash
authorityKeyIdentifier = keyid
[crl]
authorityKeyIdentifier = keyid
";

fn in_folder(folder: &Path, name: &str) -> ClientCertificate {
    ClientCertificate { certificate: folder.join(format!("{name}.pem")), key: folder.join(format!("{name}-key.pem")) }
}

fn uri(name: &str) -> String {
    format!("urn:interop:{name}")
}

fn names(uri: &str) -> String {
    format!("subjectAltName=URI:{uri},IP:127.0.0.1,DNS:localhost")
}

pub fn path(path: &Path) -> &str {
    path.to_str().expect("temporary folders have plain names")
}
