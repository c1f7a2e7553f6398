use std::path::Path;

use tokio::io::{AsyncReadExt as _, AsyncWriteExt as _};
use tokio::net::TcpStream;

use super::test_controller::{CURRENT, bounded, initial, switch_on_with};
use crate::virtual_controller::VirtualController;
use crate::virtual_controller::remote::RemoteOptions;

async fn controller(folder: &Path) -> VirtualController {
    let remote = RemoteOptions { text_port: Some(0), ..RemoteOptions::default() };
    switch_on_with(folder, initial(CURRENT), remote).await.unwrap()
}

async fn ask(stream: &mut TcpStream, line: &str) -> String {
    stream.write_all(format!("{line}\r\n").as_bytes()).await.unwrap();
    let mut answer = [0; 256];
    let length = stream.read(&mut answer).await.unwrap();
    String::from_utf8(answer[..length].to_vec()).unwrap()
}

#[tokio::test]
async fn what_a_remote_command_sets_is_there_after_a_power_off() {
    bounded(async {
        let folder = tempfile::tempdir().unwrap();
        let first = controller(folder.path()).await;
        let address = first.remote().text_address().unwrap();
        assert_eq!(first.ready_line().remote, Some(address.to_string()));
        assert_eq!(first.ready_line().remote_frames, None);
        let mut line = TcpStream::connect(address).await.unwrap();
        assert_eq!(ask(&mut line, "$Login,").await, "#Login,0\r\n");
        assert_eq!(ask(&mut line, "$Stop").await, "#Stop,0\r\n");
        assert_eq!(ask(&mut line, "$SetVariable,g_Status,-12,Integer").await, "#SetVariable,0\r\n");
        // As after a killed process: what was answered is on the disk.
        drop((line, first));

        let second = controller(folder.path()).await;
        let mut line = TcpStream::connect(second.remote().text_address().unwrap()).await.unwrap();
        assert_eq!(ask(&mut line, "$Login,").await, "#Login,0\r\n");
        assert_eq!(ask(&mut line, "$GetVariable,g_Status,Integer").await, "#GetVariable,-12\r\n");
        second.shutdown().await;
        assert_eq!(line.read(&mut [0; 8]).await.unwrap(), 0, "the client is disconnected");

        // A damaged file loses what it kept, as an empty battery does.
        std::fs::write(folder.path().join("battery.json"), b"{").unwrap();
        let third = controller(folder.path()).await;
        let mut line = TcpStream::connect(third.remote().text_address().unwrap()).await.unwrap();
        ask(&mut line, "$Login,").await;
        assert_eq!(ask(&mut line, "$GetVariable,g_Status,Integer").await, "#GetVariable,0\r\n");
    })
    .await;
}
