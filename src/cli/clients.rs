use std::path::Path;

use clap::{Subcommand, ValueEnum};
use serde_json::json;

use super::batch::{Presentation, STATE, Shown};
use super::select::{Select, ThingsThenSelect};
use super::{Ending, Settled};
use crate::jobs::{AddClientCertificates, ClientCertificateFile, ListClients, Outcome};
use crate::model::{ClientList, ErrorCode, Problem};
use crate::pki::{Certificate, MAX_CERTIFICATE_FILE_BYTES};

#[derive(Debug, Subcommand)]
pub enum ClientsCommand {
    /// List the certificates of clients that may connect
    List {
        #[arg(long, value_enum, default_value_t = List::Trusted)]
        list: List,
        #[command(flatten)]
        select: Select,
    },
    /// Add certificates of clients that may connect: FILE… CONTROLLER…
    Add {
        #[arg(long, value_enum)]
        list: List,
        #[command(flatten)]
        arguments: ThingsThenSelect,
    },
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum List {
    Trusted,
    /// Current firmware only
    Issuers,
}

impl From<List> for ClientList {
    fn from(list: List) -> Self {
        match list {
            List::Trusted => Self::Trusted,
            List::Issuers => Self::Issuers,
        }
    }
}

const CERTIFICATES: Presentation = Presentation {
    header: &["CERTIFICATES"],
    show: |outcome, _| {
        let Outcome::Clients(list) = outcome else {
            return Shown { json: json!(null), cells: Vec::new() };
        };
        let json = list
            .value
            .iter()
            .map(|c| json!({ "file_name": c.file_name, "certificate": c.summary, "added": c.added }))
            .collect::<Vec<_>>();
        let words = list
            .value
            .iter()
            .map(|c| {
                format!(
                    "{} {} until {}",
                    c.summary.thumbprint,
                    c.summary.issued_to,
                    c.summary.not_after.format("%Y-%m-%d")
                )
            })
            .collect::<Vec<_>>();
        Shown { json: json!({ "certificates": json }), cells: vec![words.join("; ")] }
    },
};

pub fn run(settled: &Settled, command: ClientsCommand) -> Result<Ending, Problem> {
    let configuration = settled.configuration()?;
    match command {
        ClientsCommand::List { list, select } => {
            settled.batch(&configuration, &select.resolve(&configuration)?, ListClients(list.into()), &CERTIFICATES)
        }
        ClientsCommand::Add { list, arguments } => {
            let (files, chosen) = arguments.resolve(&configuration)?;
            let files = files.iter().map(|f| read_certificate(Path::new(f))).collect::<Result<Vec<_>, _>>()?;
            let operation = AddClientCertificates { list: list.into(), files };
            settled.batch(&configuration, &chosen, operation, &STATE)
        }
    }
}

fn read_certificate(path: &Path) -> Result<ClientCertificateFile, Problem> {
    use std::io::Read as _;
    let shown = path.display();
    let mut bytes = Vec::new();
    std::fs::File::open(path)
        .and_then(|file| file.take(MAX_CERTIFICATE_FILE_BYTES as u64 + 1).read_to_end(&mut bytes))
        .map_err(|e| Problem::with_detail(ErrorCode::FileUnreadable, format!("{shown}: {e}")))?;
    let certificate = Certificate::from_any(&bytes)
        .map_err(|e| Problem::with_detail(ErrorCode::BadCertificate, format!("{shown}: {e}")))?;
    let file_name = path.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default();
    Ok(ClientCertificateFile { file_name, certificate })
}
